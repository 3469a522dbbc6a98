#include "scenes/gltf_files.h"

#include "relamp/error.h"
#include "scan/gltf_json.h"
#include "scan/gltf_read.h"
#include "scan/ply_read.h"
#include "scenes/pictures.h"
#include "scenes/refusal.h"

#include <stdexcept>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

namespace relamp::scenes
{
namespace
{

using nlohmann::json;

constexpr int kUnsignedShort = 5123;

size_t append(json& list, json item)
{
    list.push_back(std::move(item));
    return list.size() - 1;
}

GltfFile squareWith(const char* attribute, size_t colorAccessor, GltfFile file)
{
    const size_t positions = file.addAccessor(bytesOf(squarePositions()), 4, {});
    file.document["accessors"][positions]["min"] = {0, 0, 0};
    file.document["accessors"][positions]["max"] = {1, 1, 0};
    const size_t indices =
        file.addAccessor(bytesOf(squareIndices()), 6, {kUnsignedShort, "SCALAR"});
    const size_t mesh = file.addMesh({{"POSITION", positions}, {attribute, colorAccessor}},
                                     static_cast<int>(indices));
    file.document["meshes"][mesh]["name"] = "square";
    file.addNode({{"name", "node"}, {"mesh", mesh}});
    return file;
}

} // namespace

size_t GltfFile::addView(const Bytes& bytes, size_t stride)
{
    binary.resize((binary.size() + 3) / 4 * 4);
    json view{{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (stride != 0) view["byteStride"] = stride;
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    return append(document["bufferViews"], view);
}

size_t GltfFile::addAccessor(size_t view, size_t count, const Numbers& numbers)
{
    json accessor{{"bufferView", view},
                  {"componentType", numbers.componentType},
                  {"count", count},
                  {"type", numbers.type}};
    if (numbers.offset != 0) accessor["byteOffset"] = numbers.offset;
    if (numbers.normalized) accessor["normalized"] = true;
    return append(document["accessors"], accessor);
}

size_t GltfFile::addAccessor(const Bytes& bytes, size_t count, const Numbers& numbers)
{
    return addAccessor(addView(bytes), count, numbers);
}

size_t GltfFile::addImage(const Bytes& file, const char* mimeType)
{
    const size_t view = addView(file);
    return append(document["images"], {{"bufferView", view}, {"mimeType", mimeType}});
}

size_t GltfFile::addMaterial(int image)
{
    json material{{"name", "paint"}, {"pbrMetallicRoughness", json::object()}};
    if (image >= 0)
        material["pbrMetallicRoughness"]["baseColorTexture"]["index"] =
            append(document["textures"], {{"source", image}});
    return append(document["materials"], material);
}

size_t GltfFile::addMesh(const json& attributes, int indices, int material)
{
    json primitive{{"attributes", attributes}};
    if (indices >= 0) primitive["indices"] = indices;
    if (material >= 0) primitive["material"] = material;
    return append(document["meshes"], {{"primitives", {primitive}}});
}

size_t GltfFile::addNode(const json& node)
{
    const size_t index = append(document["nodes"], node);
    document["scenes"][0]["nodes"].push_back(index);
    document["scene"] = 0;
    return index;
}

std::string GltfFile::glb() const
{
    json whole = document;
    if (!whole.contains("buffers")) whole["buffers"] = {{{"byteLength", binary.size()}}};
    return joinGlb(whole.dump(), binary);
}

std::string GltfFile::gltf(const std::string& uri) const
{
    json whole = document;
    whole["buffers"] = {{{"byteLength", binary.size()}, {"uri", uri}}};
    return whole.dump();
}

json& GltfFile::accessorOf(const char* attribute)
{
    return document["accessors"][primitive()["attributes"][attribute].get<size_t>()];
}

std::vector<glm::vec3> squarePositions()
{
    return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
}

std::vector<glm::vec2> squareUvs()
{
    return {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
}

std::vector<uint16_t> squareIndices()
{
    return {0, 1, 2, 2, 1, 3};
}

GltfFile texturedSquare()
{
    GltfFile file;
    const size_t uvs = file.addAccessor(bytesOf(squareUvs()), 4, {.type = "VEC2"});
    file = squareWith("TEXCOORD_0", uvs, std::move(file));
    const size_t image = file.addImage(pictureFile("png", fourColors()), "image/png");
    file.primitive()["material"] = file.addMaterial(static_cast<int>(image));
    return file;
}

GltfFile coloredSquare()
{
    const std::vector<glm::vec3> colors{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    GltfFile file;
    const size_t accessor = file.addAccessor(bytesOf(colors), 4, {});
    return squareWith("COLOR_0", accessor, std::move(file));
}

GltfFile dracoSquare()
{
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int position =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    const auto indices = squareIndices();
    for (uint32_t face = 0; face < 2; ++face) {
        const auto corner = [&](size_t i) { return indices[3 * face + i]; };
        glm::vec3 positions[3];
        glm::vec2 uvs[3];
        for (size_t i = 0; i < 3; ++i) {
            positions[i] = squarePositions()[corner(i)];
            uvs[i] = squareUvs()[corner(i)];
        }
        const draco::FaceIndex at(face);
        builder.SetAttributeValuesForFace(position, at, &positions[0], &positions[1],
                                          &positions[2]);
        builder.SetAttributeValuesForFace(uv, at, &uvs[0], &uvs[1], &uvs[2]);
    }
    const auto mesh = builder.Finalize();
    draco::EncoderBuffer buffer;
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 12);
    if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok())
        throw std::runtime_error("Draco cannot encode");

    GltfFile file = texturedSquare();
    const size_t view = file.addView(Bytes(buffer.data(), buffer.data() + buffer.size()));
    for (const char* attribute : {"POSITION", "TEXCOORD_0"})
        file.accessorOf(attribute).erase("bufferView");
    file.document["accessors"][file.primitive()["indices"].get<size_t>()].erase("bufferView");
    const auto idOf = [&](int attribute) { return mesh->attribute(attribute)->unique_id(); };
    file.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", view},
        {"attributes", {{"POSITION", idOf(position)}, {"TEXCOORD_0", idOf(uv)}}}};
    file.document["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    file.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return file;
}

namespace
{

/// Replaces what a view holds by a stream; the view itself moves to a buffer that is not stored.
void compressView(GltfFile& file, size_t view, const Bytes& stream, json extension)
{
    json& target = file.document["bufferViews"][view];
    const size_t at = (file.binary.size() + 3) / 4 * 4;
    file.binary.resize(at);
    file.binary.insert(file.binary.end(), stream.begin(), stream.end());
    extension["buffer"] = 0;
    extension["byteOffset"] = at;
    extension["byteLength"] = stream.size();
    target["extensions"]["EXT_meshopt_compression"] = extension;
    target["buffer"] = 1;
}

} // namespace

GltfFile meshoptSquare()
{
    GltfFile file = texturedSquare();
    const auto viewOf = [&](const json& accessor) { return accessor["bufferView"].get<size_t>(); };
    const auto compressVertices = [&](const char* attribute, const void* vertices, size_t stride) {
        Bytes stream(meshopt_encodeVertexBufferBound(4, stride));
        stream.resize(
            meshopt_encodeVertexBuffer(stream.data(), stream.size(), vertices, 4, stride));
        const size_t view = viewOf(file.accessorOf(attribute));
        file.document["bufferViews"][view]["byteStride"] = stride;
        compressView(file, view, stream,
                     {{"count", 4}, {"byteStride", stride}, {"mode", "ATTRIBUTES"}});
    };
    compressVertices("POSITION", squarePositions().data(), sizeof(glm::vec3));
    compressVertices("TEXCOORD_0", squareUvs().data(), sizeof(glm::vec2));

    const std::vector<uint32_t> indices{0, 1, 2, 2, 1, 3};
    Bytes stream(meshopt_encodeIndexBufferBound(indices.size(), 4));
    stream.resize(
        meshopt_encodeIndexBuffer(stream.data(), stream.size(), indices.data(), indices.size()));
    const size_t view =
        viewOf(file.document["accessors"][file.primitive()["indices"].get<size_t>()]);
    compressView(file, view, stream, {{"count", 6}, {"byteStride", 2}, {"mode", "TRIANGLES"}});

    const json fallback{{"byteLength", 4096},
                        {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}};
    file.document["buffers"] = {{{"byteLength", file.binary.size()}}, fallback};
    file.document["extensionsUsed"] = {"EXT_meshopt_compression"};
    file.document["extensionsRequired"] = {"EXT_meshopt_compression"};
    return file;
}

std::span<const std::byte> asBytes(const std::string& text)
{
    return std::as_bytes(std::span(text));
}

Scan read(const std::string& bytes, const ScanOptions& options, const std::string& name)
{
    Progress progress;
    return isPly(asBytes(bytes)) ? readPly(asBytes(bytes), name, options, progress)
                                 : readGltf(asBytes(bytes), name, options, progress);
}

std::string refusal(const std::string& bytes, const std::string& name)
{
    return refusalOf([&] { read(bytes, {}, name); });
}

} // namespace relamp::scenes
