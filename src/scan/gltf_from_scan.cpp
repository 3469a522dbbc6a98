#include "scan/gltf_from_scan.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include <glm/common.hpp>

namespace relamp
{
namespace
{

using tinygltf::Model;

template<class Element>
int addView(Model& model, const std::vector<Element>& elements, int target)
{
    auto& bytes = model.buffers.at(0).data;
    bytes.resize((bytes.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes.size();
    view.byteLength = elements.size() * sizeof(Element);
    view.target = target;
    bytes.resize(bytes.size() + view.byteLength);
    std::memcpy(bytes.data() + view.byteOffset, elements.data(), view.byteLength);
    model.bufferViews.push_back(view);
    return static_cast<int>(model.bufferViews.size()) - 1;
}

template<class Element>
int addAccessor(Model& model, const std::vector<Element>& elements, int target, int componentType, int type)
{
    tinygltf::Accessor accessor;
    accessor.bufferView = addView(model, elements, target);
    accessor.componentType = componentType;
    accessor.type = type;
    accessor.count = elements.size() * sizeof(Element) /
                     static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(componentType)) *
                                         tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type)));
    model.accessors.push_back(accessor);
    return static_cast<int>(model.accessors.size()) - 1;
}

void setPositionBounds(const Mesh& mesh, tinygltf::Accessor& accessor)
{
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(-std::numeric_limits<float>::max());
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    for (int c = 0; c < 3; ++c) {
        accessor.minValues.push_back(static_cast<double>(low[c]));
        accessor.maxValues.push_back(static_cast<double>(high[c]));
    }
}

int wrapAsGltf(Wrap wrap)
{
    if (wrap == Wrap::clamp) return TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    return wrap == Wrap::mirror ? TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT : TINYGLTF_TEXTURE_WRAP_REPEAT;
}

int addMaterial(Model& model, const Scan& scan, const Mesh& mesh)
{
    tinygltf::Material material;
    material.name = mesh.name;
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    if (!scan.pages[static_cast<size_t>(mesh.page)].ofVertices) {
        tinygltf::Sampler sampler;
        sampler.wrapS = wrapAsGltf(mesh.wrapU);
        sampler.wrapT = wrapAsGltf(mesh.wrapV);
        model.samplers.push_back(sampler);
        tinygltf::Texture texture;
        texture.sampler = static_cast<int>(model.samplers.size()) - 1;
        texture.source = mesh.page; // images are in the order of the pages, the page of vertices last
        model.textures.push_back(texture);
        material.pbrMetallicRoughness.baseColorTexture.index = static_cast<int>(model.textures.size()) - 1;
    }
    model.materials.push_back(material);
    return static_cast<int>(model.materials.size()) - 1;
}

void addMesh(GltfSource& source, const Scan& scan, const Mesh& mesh)
{
    Model& model = source.model;
    constexpr int kFloat = TINYGLTF_COMPONENT_TYPE_FLOAT;
    constexpr int kVertices = TINYGLTF_TARGET_ARRAY_BUFFER;
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = addAccessor(model, mesh.positions, kVertices, kFloat, TINYGLTF_TYPE_VEC3);
    setPositionBounds(mesh, model.accessors.back());
    if (!mesh.uvs.empty())
        primitive.attributes["TEXCOORD_0"] = addAccessor(model, mesh.uvs, kVertices, kFloat, TINYGLTF_TYPE_VEC2);
    primitive.indices = addAccessor(model, mesh.triangles, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER,
                                    TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR);
    primitive.material = addMaterial(model, scan, mesh);

    tinygltf::Mesh target;
    target.name = mesh.name;
    target.primitives.push_back(primitive);
    model.meshes.push_back(target);
    tinygltf::Node node;
    node.name = mesh.name;
    node.mesh = static_cast<int>(model.meshes.size()) - 1;
    model.nodes.push_back(node);
    model.scenes.at(0).nodes.push_back(static_cast<int>(model.nodes.size()) - 1);
    source.originOfMesh.push_back({node.mesh, 0});
}

} // namespace

GltfSource gltfFromScan(const Scan& scan)
{
    GltfSource source;
    Model& model = source.model;
    model.asset.version = "2.0";
    model.asset.generator = "relamp";
    model.buffers.resize(1);
    model.scenes.resize(1);
    model.defaultScene = 0;
    for (const Page& page : scan.pages) {
        source.imageOfPage.push_back(page.ofVertices ? -1 : static_cast<int>(model.images.size()));
        if (page.ofVertices) continue;
        tinygltf::Image image;
        image.name = std::filesystem::path(page.name).stem().string();
        model.images.push_back(image);
    }
    for (const Mesh& mesh : scan.meshes) addMesh(source, scan, mesh);
    return source;
}

} // namespace relamp
