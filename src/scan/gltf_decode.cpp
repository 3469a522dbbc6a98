#include "scan/gltf_decode.h"

#include "base/fail.h"

#include <cstring>

#include <draco/compression/decode.h>
#include <fmt/format.h>
#include <meshoptimizer.h>
#include <tiny_gltf.h>

namespace relamp
{
namespace
{

// The meshopt vertex codec stores at least one bit pair for sixteen bytes. A stream that claims to
// unpack further is lying.
constexpr uint64_t kMostMeshoptExpansion = 64;
constexpr uint64_t kMostDracoPoints = uint64_t{1} << 28;

template<class Component>
std::vector<uint8_t> valuesAs(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                              size_t components)
{
    const size_t stride = alignedStride(components * sizeof(Component));
    std::vector<uint8_t> bytes(mesh.num_points() * stride);
    auto* target = bytes.data();
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
        Component values[4] = {};
        attribute.ConvertValue<Component>(attribute.mapped_index(point),
                                          static_cast<int8_t>(components), values);
        std::memcpy(target, values, components * sizeof(Component));
        target += stride;
    }
    return bytes;
}

void applyFilter(std::vector<uint8_t>& bytes, const MeshoptStream& stream, const std::string& what)
{
    if (stream.filter == "NONE") return;
    const bool octahedral =
        stream.filter == "OCTAHEDRAL" && (stream.stride == 4 || stream.stride == 8);
    const bool quaternion = stream.filter == "QUATERNION" && stream.stride == 8;
    const bool exponential = stream.filter == "EXPONENTIAL" && stream.stride % 4 == 0;
    if (octahedral)
        meshopt_decodeFilterOct(bytes.data(), stream.count, stream.stride);
    else if (quaternion)
        meshopt_decodeFilterQuat(bytes.data(), stream.count, stream.stride);
    else if (exponential)
        meshopt_decodeFilterExp(bytes.data(), stream.count, stream.stride);
    else
        malformed(what, fmt::format("its meshopt filter \"{}\" does not go with a stride of {}",
                                    stream.filter, stream.stride));
}

} // namespace

std::vector<uint8_t> decodeMeshopt(const MeshoptStream& stream, const std::string& what)
{
    const bool attributes = stream.mode == "ATTRIBUTES" && stream.stride > 0 &&
                            stream.stride <= 256 && stream.stride % 4 == 0;
    const bool triangles = stream.mode == "TRIANGLES" && stream.count % 3 == 0 &&
                           (stream.stride == 2 || stream.stride == 4);
    const bool indices = stream.mode == "INDICES" && (stream.stride == 2 || stream.stride == 4);
    const uint64_t most = kMostMeshoptExpansion * stream.bytes.size() + 4096;
    if (!(attributes || triangles || indices) || stream.count > most / stream.stride)
        malformed(what, "its EXT_meshopt_compression breaks the rules of that extension");

    std::vector<uint8_t> bytes(stream.count * stream.stride);
    const auto* source = stream.bytes.data();
    const size_t size = stream.bytes.size();
    const int failure =
        attributes
            ? meshopt_decodeVertexBuffer(bytes.data(), stream.count, stream.stride, source, size)
        : triangles
            ? meshopt_decodeIndexBuffer(bytes.data(), stream.count, stream.stride, source, size)
            : meshopt_decodeIndexSequence(bytes.data(), stream.count, stream.stride, source, size);
    if (failure != 0) malformed(what, "its meshopt data is damaged; export it again");
    if (attributes) applyFilter(bytes, stream, what);
    return bytes;
}

DracoMesh::DracoMesh(std::span<const uint8_t> bytes, const std::string& what)
{
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        malformed(what, fmt::format("its Draco data is damaged ({}); export it again",
                                    decoded.status().error_msg()));
    mesh_ = std::move(decoded).value();
    if (mesh_->num_points() > kMostDracoPoints)
        malformed(what, "its Draco data claims too many points");
    for (draco::FaceIndex face(0); face < mesh_->num_faces(); ++face)
        for (const draco::PointIndex& corner : mesh_->face(face))
            if (corner >= mesh_->num_points())
                malformed(what, "its Draco data has an index out of range");
}

DracoMesh::~DracoMesh() = default;

size_t DracoMesh::points() const
{
    return mesh_->num_points();
}

std::vector<uint8_t> DracoMesh::indices() const
{
    std::vector<uint8_t> bytes(size_t{3} * mesh_->num_faces() * sizeof(uint32_t));
    auto* target = bytes.data();
    for (draco::FaceIndex face(0); face < mesh_->num_faces(); ++face)
        for (const draco::PointIndex& corner : mesh_->face(face)) {
            const uint32_t index = corner.value();
            std::memcpy(target, &index, sizeof index);
            target += sizeof index;
        }
    return bytes;
}

std::vector<uint8_t> DracoMesh::attribute(uint32_t id, int componentType, size_t components,
                                          const std::string& what) const
{
    const draco::PointAttribute* attribute = mesh_->GetAttributeByUniqueId(id);
    if (attribute == nullptr || components == 0)
        malformed(what, fmt::format("its Draco data lacks attribute {}", id));
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return valuesAs<int8_t>(*mesh_, *attribute, components);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return valuesAs<uint8_t>(*mesh_, *attribute, components);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return valuesAs<int16_t>(*mesh_, *attribute, components);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return valuesAs<uint16_t>(*mesh_, *attribute, components);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return valuesAs<uint32_t>(*mesh_, *attribute, components);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return valuesAs<float>(*mesh_, *attribute, components);
    default:
        malformed(what, fmt::format("componentType {} is none of glTF's", componentType));
    }
}

size_t componentsOf(const std::string& accessorType)
{
    if (accessorType == "SCALAR") return 1;
    if (accessorType == "VEC2") return 2;
    if (accessorType == "VEC3") return 3;
    if (accessorType == "VEC4") return 4;
    return 0;
}

} // namespace relamp
