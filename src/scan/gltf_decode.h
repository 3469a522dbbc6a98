#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace draco
{
class Mesh;
}

namespace relamp
{

/// Content of a buffer view under EXT_meshopt_compression.
struct MeshoptStream
{
    std::span<const uint8_t> bytes;
    uint64_t count;     // elements
    uint64_t stride;    // bytes an element
    std::string mode;   // ATTRIBUTES, TRIANGLES or INDICES
    std::string filter; // NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
};

/// The plain bytes, count * stride of them. Throws Error(malformed), beginning with `what`.
std::vector<uint8_t> decodeMeshopt(const MeshoptStream& stream, const std::string& what);

/// A mesh under KHR_draco_mesh_compression.
class DracoMesh
{
public:
    /// Throws Error(malformed), beginning with `what`.
    DracoMesh(std::span<const uint8_t> bytes, const std::string& what);
    ~DracoMesh();
    DracoMesh(const DracoMesh&) = delete;
    DracoMesh& operator=(const DracoMesh&) = delete;

    [[nodiscard]] size_t points() const;
    /// 32-bit indices of a triangle list.
    [[nodiscard]] std::vector<uint8_t> indices() const;
    /// Values of the attribute with `id` at all points, as glTF `componentType`, each at a multiple
    /// of alignedStride(its size).
    [[nodiscard]] std::vector<uint8_t> attribute(uint32_t id, int componentType, size_t components,
                                                 const std::string& what) const;

private:
    std::unique_ptr<draco::Mesh> mesh_;
};

/// glTF wants every vertex attribute to start at a multiple of four bytes.
constexpr size_t alignedStride(size_t elementSize)
{
    return (elementSize + 3) / 4 * 4;
}

/// 1 for SCALAR to 4 for VEC4; 0 for what cannot be an attribute.
size_t componentsOf(const std::string& accessorType);

} // namespace relamp
