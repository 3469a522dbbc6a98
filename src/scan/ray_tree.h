#pragma once

#include "relamp/scan.h"

#include <vector>

#include <glm/vec4.hpp>

namespace relamp
{

/// The scan's triangles in a tree of boxes, as scan/trace.glsl walks it.
///
/// A node is four entries: low and high corner of each of its two children's boxes; low's w is
/// where that child is, high's w how many triangles it has. A child without triangles is a node. A
/// triangle is three entries: a corner and the ways from it to the others; the first w is its
/// facet. Floats are kept as their bits.
struct RayTree
{
    explicit RayTree(const Scan& scan);

    std::vector<glm::uvec4> nodes; // the first is the root
    std::vector<glm::uvec4> triangles;

    static constexpr size_t kMostDepth = 48; // of nodes; the walk has room for as many
};

} // namespace relamp
