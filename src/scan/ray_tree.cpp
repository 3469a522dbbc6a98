#include "scan/ray_tree.h"

#include <array>
#include <bit>
#include <limits>
#include <memory>
#include <new>

#include <embree3/rtcore.h>

namespace relamp
{
namespace
{

constexpr unsigned kMostInLeaf = 4;

struct Box
{
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};
};

/// A node as Embree's builder makes it: two children, or triangles.
struct Built
{
    std::array<const Built*, 2> children{};
    std::array<Box, 2> boxes;
    std::array<unsigned, kMostInLeaf> triangles{};
    unsigned count = 0; // of triangles
};

Box boxFrom(const RTCBounds& b)
{
    return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

Built* allocate(RTCThreadLocalAllocator allocator)
{
    return new (rtcThreadLocalAlloc(allocator, sizeof(Built), alignof(Built))) Built;
}

void* createNode(RTCThreadLocalAllocator allocator, unsigned /*children*/, void* /*user*/)
{
    return allocate(allocator);
}

void setChildren(void* node, void** children, unsigned count, void* /*user*/)
{
    for (unsigned i = 0; i < count; ++i)
        static_cast<Built*>(node)->children[i] = static_cast<Built*>(children[i]);
}

void setBounds(void* node, const RTCBounds** bounds, unsigned count, void* /*user*/)
{
    for (unsigned i = 0; i < count; ++i) static_cast<Built*>(node)->boxes[i] = boxFrom(*bounds[i]);
}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                 size_t count, void* /*user*/)
{
    Built* leaf = allocate(allocator);
    leaf->count = static_cast<unsigned>(count);
    for (size_t i = 0; i < count; ++i) leaf->triangles[i] = primitives[i].primID;
    return leaf;
}

struct Corners
{
    glm::vec3 at[3]{};
};

std::vector<Corners> cornersOf(const Scan& scan)
{
    std::vector<Corners> corners;
    corners.reserve(scan.triangleCount());
    for (const Mesh& mesh : scan.meshes)
        for (const glm::uvec3& t : mesh.triangles)
            corners.push_back({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]});
    if (corners.empty()) corners.emplace_back(); // a triangle without area, which no ray meets
    return corners;
}

std::vector<RTCBuildPrimitive> primitivesOf(const std::vector<Corners>& corners)
{
    std::vector<RTCBuildPrimitive> primitives(corners.size());
    for (size_t i = 0; i < corners.size(); ++i) {
        const auto& [a, b, c] = corners[i].at;
        const glm::vec3 low = glm::min(a, glm::min(b, c));
        const glm::vec3 high = glm::max(a, glm::max(b, c));
        primitives[i] = {low.x, low.y, low.z, 0, high.x, high.y, high.z, static_cast<unsigned>(i)};
    }
    return primitives;
}

glm::uvec4 entry(glm::vec3 v, uint32_t w)
{
    return {std::bit_cast<uint32_t>(v.x), std::bit_cast<uint32_t>(v.y),
            std::bit_cast<uint32_t>(v.z), w};
}

/// Puts what was built one after the other, depth first.
class Writer
{
public:
    Writer(RayTree& tree, const std::vector<Corners>& corners) : tree_(tree), corners_(corners) {}

    /// Where the node is.
    uint32_t node(const Built& built)
    {
        const size_t at = tree_.nodes.size();
        tree_.nodes.resize(at + 4);
        for (size_t c = 0; c < 2; ++c) {
            const auto [first, count] = child(built.children[c]);
            tree_.nodes[at + 2 * c] = entry(built.boxes[c].low, first);
            tree_.nodes[at + 2 * c + 1] = entry(built.boxes[c].high, count);
        }
        return static_cast<uint32_t>(at / 4);
    }

private:
    std::pair<uint32_t, uint32_t> child(const Built* built)
    {
        if (built->count == 0) return {node(*built), 0};
        const auto first = static_cast<uint32_t>(tree_.triangles.size() / 3);
        for (unsigned i = 0; i < built->count; ++i) {
            const uint32_t facet = built->triangles[i];
            const auto& [a, b, c] = corners_[facet].at;
            tree_.triangles.push_back(entry(a, facet));
            tree_.triangles.push_back(entry(b - a, 0));
            tree_.triangles.push_back(entry(c - a, 0));
        }
        return {first, built->count};
    }

    RayTree& tree_;
    const std::vector<Corners>& corners_;
};

using DeviceHandle = std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)>;
using TreeHandle = std::unique_ptr<RTCBVHTy, decltype(&rtcReleaseBVH)>;

} // namespace

RayTree::RayTree(const Scan& scan)
{
    const std::vector<Corners> corners = cornersOf(scan);
    std::vector<RTCBuildPrimitive> primitives = primitivesOf(corners);
    const DeviceHandle device(rtcNewDevice(nullptr), rtcReleaseDevice);
    const TreeHandle memory(rtcNewBVH(device.get()), rtcReleaseBVH);
    RTCBuildArguments build = rtcDefaultBuildArguments();
    build.byteSize = sizeof(build);
    build.maxBranchingFactor = 2;
    build.maxDepth = kMostDepth - 8; // Embree goes a few beyond it
    build.maxLeafSize = kMostInLeaf;
    build.bvh = memory.get();
    build.primitives = primitives.data();
    build.primitiveCount = primitives.size();
    build.primitiveArrayCapacity = primitives.size();
    build.createNode = createNode;
    build.setNodeChildren = setChildren;
    build.setNodeBounds = setBounds;
    build.createLeaf = createLeaf;
    const auto* root = static_cast<const Built*>(rtcBuildBVH(&build));

    if (root == nullptr) throw std::bad_alloc();
    triangles.reserve(3 * corners.size());
    const Box all{boundsOf(scan).low, boundsOf(scan).high};
    const Built above{.children = {root, root}, .boxes = {all, all}}; // of a root that is a leaf
    Writer(*this, corners).node(root->count == 0 ? *root : above);
}

} // namespace relamp
