#include "scan/gltf_write.h"

#include "base/fail.h"
#include "scan/gltf_from_scan.h"
#include "scan/gltf_material.h"
#include "scan/gltf_read.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

namespace relamp
{
namespace
{

using tinygltf::Model;
using tinygltf::Value;

constexpr size_t kLargestGlb = (size_t{1} << 32) - (size_t{1} << 20);

/// Edits a copy of the model a scan came from.
class GlbWriter
{
public:
    GlbWriter(const Scan& scan, const std::vector<RelitPage>& pages)
        : scan_(scan), pages_(pages), source_(scan.gltf ? *scan.gltf : gltfFromScan(scan)),
          model_(source_.model), worldFromModel_(scan.gltf ? scan.worldFromFile : glm::mat4(1.0f))
    {}

    std::string write(const std::vector<PointLight>& lights);

private:
    int addView(const void* bytes, size_t size, int target);
    void replaceImages();
    void replaceTextureSources();
    void relitMaterials();
    void relitMaterial(tinygltf::Material& material, const BaseColor& color);
    void setEmission(tinygltf::Material& material, size_t page);
    void replaceVertexColors();
    void dropColorsThatAreBakedIn();
    void addLight(const PointLight& light, size_t number);
    void dropUnusedExtensions();
    void compactBuffer();

    const Scan& scan_;
    const std::vector<RelitPage>& pages_;
    GltfSource source_;
    Model& model_;
    glm::mat4 worldFromModel_;
    std::map<int, int> emissionTextureOfPage_;
};

int GlbWriter::addView(const void* bytes, size_t size, int target)
{
    if (model_.buffers.empty()) model_.buffers.resize(1);
    auto& data = model_.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = size;
    view.target = target;
    data.resize(data.size() + size);
    std::memcpy(data.data() + view.byteOffset, bytes, size);
    model_.bufferViews.push_back(view);
    return static_cast<int>(model_.bufferViews.size()) - 1;
}

void GlbWriter::replaceImages()
{
    for (size_t p = 0; p < pages_.size(); ++p) {
        const int index = source_.imageOfPage[p];
        if (index < 0) continue;
        tinygltf::Image& image = model_.images[static_cast<size_t>(index)];
        const EncodedImage& albedo = pages_[p].albedo;
        const int view = addView(albedo.bytes.data(), albedo.bytes.size(), 0);
        if (image.bufferView >= 0) { // in the old one's place, so that nothing else is renumbered
            auto& old = model_.bufferViews[static_cast<size_t>(image.bufferView)];
            old = model_.bufferViews[static_cast<size_t>(view)];
            model_.bufferViews.pop_back();
        } else {
            image.bufferView = view;
        }
        image.uri.clear();
        image.mimeType = albedo.mimeType;
    }
}

/// A page's texture may have named a WebP besides; there is one picture now.
void GlbWriter::replaceTextureSources()
{
    for (size_t t = 0; t < model_.textures.size(); ++t) {
        tinygltf::Texture& texture = model_.textures[t];
        if (!texture.extensions.contains("EXT_texture_webp")) continue;
        const int image = imageOfTexture(model_, static_cast<int>(t), scan_.name);
        const auto& images = source_.imageOfPage;
        if (std::find(images.begin(), images.end(), image) == images.end()) continue;
        texture.source = image;
        texture.extensions.erase("EXT_texture_webp");
    }
}

void GlbWriter::setEmission(tinygltf::Material& material, size_t page)
{
    const EncodedImage& emission = pages_[page].emission;
    if (emission.bytes.empty()) return;
    const auto [found, isNew] = emissionTextureOfPage_.try_emplace(static_cast<int>(page), 0);
    const tinygltf::TextureInfo& base = material.pbrMetallicRoughness.baseColorTexture;
    if (isNew) {
        tinygltf::Image image;
        image.name = scan_.pages[page].name + " emission";
        image.mimeType = emission.mimeType;
        image.bufferView = addView(emission.bytes.data(), emission.bytes.size(), 0);
        model_.images.push_back(image);
        tinygltf::Texture texture;
        texture.sampler = model_.textures[static_cast<size_t>(base.index)].sampler;
        texture.source = static_cast<int>(model_.images.size()) - 1;
        model_.textures.push_back(texture);
        found->second = static_cast<int>(model_.textures.size()) - 1;
    }
    material.emissiveTexture = base; // the same coordinates, under the same transform
    material.emissiveTexture.index = found->second;
    material.emissiveFactor = {1.0, 1.0, 1.0};
}

void GlbWriter::relitMaterial(tinygltf::Material& material, const BaseColor& color)
{
    tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
    if (const auto old = material.extensions.find("KHR_materials_pbrSpecularGlossiness");
        old != material.extensions.end() && pbr.baseColorTexture.index < 0 && color.image >= 0) {
        const Value& diffuse = old->second.Get("diffuseTexture");
        pbr.baseColorTexture.index = diffuse.Get("index").Get<int>();
        pbr.baseColorTexture.texCoord = color.texCoord;
        if (diffuse.Get("extensions").IsObject())
            pbr.baseColorTexture.extensions = diffuse.Get("extensions").Get<Value::Object>();
    }
    material.extensions.erase("KHR_materials_pbrSpecularGlossiness");
    material.extensions.erase("KHR_materials_unlit"); // an unlit surface could not be relit
    const double alpha = pbr.baseColorFactor.size() == 4 ? pbr.baseColorFactor[3] : 1.0;
    pbr.baseColorFactor = {1.0, 1.0, 1.0, alpha}; // the factor is in the albedo now
    if (pbr.metallicRoughnessTexture.index < 0) {
        pbr.metallicFactor = 0.0;
        pbr.roughnessFactor = 1.0;
    }
}

void GlbWriter::relitMaterials()
{
    for (size_t m = 0; m < model_.materials.size(); ++m) {
        const BaseColor color = baseColorOf(model_, static_cast<int>(m), scan_.name);
        relitMaterial(model_.materials[m], color);
        const auto& images = source_.imageOfPage;
        const auto page = std::find(images.begin(), images.end(), color.image);
        if (color.image >= 0 && page != images.end())
            setEmission(model_.materials[m], static_cast<size_t>(page - images.begin()));
    }
}

void GlbWriter::replaceVertexColors()
{
    for (size_t m = 0; m < scan_.meshes.size(); ++m) {
        const Mesh& mesh = scan_.meshes[m];
        const auto page = static_cast<size_t>(mesh.page);
        if (!scan_.pages[page].ofVertices) continue;
        const auto [meshIndex, primitiveIndex] = source_.originOfMesh[m];
        tinygltf::Accessor accessor;
        const float* first = pages_[page].vertexAlbedo.data() + 3 * mesh.firstPixel;
        accessor.bufferView = addView(first, 3 * sizeof(float) * mesh.positions.size(), TINYGLTF_TARGET_ARRAY_BUFFER);
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
        accessor.type = TINYGLTF_TYPE_VEC3;
        accessor.count = mesh.positions.size();
        model_.accessors.push_back(accessor);
        model_.meshes[static_cast<size_t>(meshIndex)]
            .primitives[static_cast<size_t>(primitiveIndex)]
            .attributes["COLOR_0"] = static_cast<int>(model_.accessors.size()) - 1;
    }
}

void GlbWriter::dropColorsThatAreBakedIn()
{
    for (size_t m = 0; m < scan_.meshes.size(); ++m) {
        const auto [mesh, primitive] = source_.originOfMesh[m];
        if (!scan_.pages[static_cast<size_t>(scan_.meshes[m].page)].ofVertices)
            model_.meshes[static_cast<size_t>(mesh)].primitives[static_cast<size_t>(primitive)].attributes.erase("COLOR_0");
    }
}

void GlbWriter::addLight(const PointLight& light, size_t number)
{
    const float strongest = std::max({light.intensity.r, light.intensity.g, light.intensity.b});
    if (strongest <= 0.0f) return;
    const float unit = glm::length(glm::vec3(worldFromModel_[0])); // metres a unit of the model
    tinygltf::Light punctual;
    punctual.name = fmt::format("relamp {}", number);
    punctual.type = "point";
    punctual.intensity = static_cast<double>(strongest / (unit * unit));
    for (int c = 0; c < 3; ++c) punctual.color.push_back(static_cast<double>(light.intensity[c] / strongest));
    model_.lights.push_back(punctual);

    tinygltf::Node node;
    node.name = punctual.name;
    const glm::vec3 place = glm::inverse(worldFromModel_) * glm::vec4(light.position, 1.0f);
    node.translation = {static_cast<double>(place.x), static_cast<double>(place.y), static_cast<double>(place.z)};
    node.extensions["KHR_lights_punctual"] =
        Value(Value::Object{{"light", Value(static_cast<int>(model_.lights.size()) - 1)}});
    model_.nodes.push_back(node);
    const auto scene = static_cast<size_t>(std::max(model_.defaultScene, 0));
    if (model_.scenes.empty()) model_.scenes.resize(1);
    model_.scenes[scene].nodes.push_back(static_cast<int>(model_.nodes.size()) - 1);
}

void GlbWriter::dropUnusedExtensions()
{
    const auto usedBy = [](const auto& things, const std::string& name) {
        return std::any_of(things.begin(), things.end(), [&](const auto& t) { return t.extensions.contains(name); });
    };
    const auto isUnused = [&](const std::string& name) {
        const bool ofMaterials = name == "KHR_materials_unlit" || name == "KHR_materials_pbrSpecularGlossiness";
        return (ofMaterials && !usedBy(model_.materials, name)) ||
               (name == "EXT_texture_webp" && !usedBy(model_.textures, name));
    };
    std::erase_if(model_.extensionsUsed, isUnused);
    std::erase_if(model_.extensionsRequired, isUnused);
}

/// Copies only what buffer views still show: the old pictures stay behind.
void GlbWriter::compactBuffer()
{
    if (model_.buffers.empty()) return;
    const std::vector<unsigned char> old = std::move(model_.buffers[0].data);
    std::vector<unsigned char>& data = model_.buffers[0].data;
    data.clear();
    std::map<std::pair<size_t, size_t>, size_t> moved;
    for (tinygltf::BufferView& view : model_.bufferViews) {
        const auto [found, isNew] = moved.try_emplace({view.byteOffset, view.byteLength}, 0);
        if (isNew) {
            data.resize((data.size() + 15) / 16 * 16);
            found->second = data.size();
            if (data.size() + view.byteLength > kLargestGlb)
                fail(ErrorCode::unsupported, scan_.name, "its GLB would exceed 4 GiB; scale the textures down");
            const auto* first = old.data() + view.byteOffset;
            data.insert(data.end(), first, first + view.byteLength);
        }
        view.byteOffset = found->second;
    }
}

std::string GlbWriter::write(const std::vector<PointLight>& lights)
{
    replaceImages();
    replaceTextureSources();
    relitMaterials();
    replaceVertexColors();
    dropColorsThatAreBakedIn();
    for (size_t i = 0; i < lights.size(); ++i) addLight(lights[i], i);
    dropUnusedExtensions();
    compactBuffer();
    std::ostringstream glb;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, glb, false, true);
    return std::move(glb).str();
}

} // namespace

std::string writeGlb(const Scan& scan, const std::vector<RelitPage>& pages, const std::vector<PointLight>& lights)
{
    return GlbWriter(scan, pages).write(lights);
}

} // namespace relamp
