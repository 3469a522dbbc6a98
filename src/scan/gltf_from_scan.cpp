#include "scan/gltf_from_scan.h"

#include "scan/gltf_json.h"

#include <array>
#include <limits>
#include <span>
#include <string>

#include <glm/common.hpp>

namespace relamp
{
namespace
{

using nlohmann::json;

size_t append(json& list, json item)
{
    list.push_back(std::move(item));
    return list.size() - 1;
}

/// Index of a new accessor for `elements`; the numbers of each fill a `type` of `componentType`.
template<class Element>
size_t addAccessor(GltfSource& source, const std::vector<Element>& elements, json accessor,
                   int target)
{
    const auto bytes = std::as_bytes(std::span(elements));
    source.binary.resize((source.binary.size() + 3) / 4 * 4);
    accessor["bufferView"] =
        append(source.document["bufferViews"], {{"buffer", 0},
                                                {"byteOffset", source.binary.size()},
                                                {"byteLength", bytes.size()},
                                                {"target", target}});
    const auto* first = reinterpret_cast<const uint8_t*>(bytes.data());
    source.binary.insert(source.binary.end(), first, first + bytes.size());
    return append(source.document["accessors"], std::move(accessor));
}

json positionAccessor(const std::vector<glm::vec3>& positions)
{
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(-std::numeric_limits<float>::max());
    for (const glm::vec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return {{"componentType", kFloat},
            {"type", "VEC3"},
            {"count", positions.size()},
            {"min", {low.x, low.y, low.z}},
            {"max", {high.x, high.y, high.z}}};
}

int asGltf(Wrap wrap)
{
    constexpr std::array kGltf{10497, 33648, 33071}; // repeat, mirrored repeat, clamp to edge
    return kGltf[static_cast<size_t>(wrap)];
}

size_t addMaterial(GltfSource& source, const Scan& scan, const Mesh& mesh)
{
    json& document = source.document;
    json material{{"name", mesh.name}, {"pbrMetallicRoughness", {{"metallicFactor", 0.0}}}};
    if (!scan.pages[static_cast<size_t>(mesh.page)].ofVertices) {
        const size_t sampler = append(
            document["samplers"], {{"wrapS", asGltf(mesh.wrapU)}, {"wrapT", asGltf(mesh.wrapV)}});
        const int image = source.imageOfPage[static_cast<size_t>(mesh.page)];
        source.imageOfTexture.push_back(image);
        material["pbrMetallicRoughness"]["baseColorTexture"]["index"] =
            append(document["textures"], {{"sampler", sampler}, {"source", image}});
    }
    return append(document["materials"], std::move(material));
}

void addMesh(GltfSource& source, const Scan& scan, const Mesh& mesh)
{
    json attributes{{"POSITION", addAccessor(source, mesh.positions,
                                             positionAccessor(mesh.positions), kArrayBuffer)}};
    if (!mesh.uvs.empty())
        attributes["TEXCOORD_0"] =
            addAccessor(source, mesh.uvs,
                        {{"componentType", kFloat}, {"type", "VEC2"}, {"count", mesh.uvs.size()}},
                        kArrayBuffer);
    const size_t indices = addAccessor(
        source, mesh.triangles,
        {{"componentType", kUnsignedInt}, {"type", "SCALAR"}, {"count", 3 * mesh.triangles.size()}},
        kElementArrayBuffer);
    json& document = source.document;
    const json primitive{{"attributes", std::move(attributes)},
                         {"indices", indices},
                         {"material", addMaterial(source, scan, mesh)}};
    const size_t index =
        append(document["meshes"], {{"name", mesh.name}, {"primitives", {primitive}}});
    const size_t node = append(document["nodes"], {{"name", mesh.name}, {"mesh", index}});
    document["scenes"][0]["nodes"].push_back(node);
    source.originOfMesh.push_back({static_cast<int>(node), static_cast<int>(index), 0});
}

} // namespace

GltfSource gltfFromScan(const Scan& scan)
{
    GltfSource source;
    source.document = {{"asset", {{"version", "2.0"}, {"generator", "relamp"}}}, {"scene", 0}};
    json& images = source.document["images"];
    for (const Page& page : scan.pages) {
        source.imageOfPage.push_back(page.ofVertices ? -1 : static_cast<int>(images.size()));
        if (!page.ofVertices)
            images.push_back({{"name", std::filesystem::path(page.name).stem().string()}});
    }
    for (const Mesh& mesh : scan.meshes) addMesh(source, scan, mesh);
    return source;
}

} // namespace relamp
