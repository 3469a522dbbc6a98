#include "scan/ray_tree.h"

#include "scenes/scenes.h"

#include <algorithm>
#include <bit>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

glm::vec3 vectorOf(glm::uvec4 entry)
{
    return {std::bit_cast<float>(entry.x), std::bit_cast<float>(entry.y),
            std::bit_cast<float>(entry.z)};
}

/// Walks the whole tree and notes which triangles it comes by, and whether their boxes hold them.
struct Walk
{
    const RayTree& tree;
    std::vector<uint32_t> facets;
    bool isInside = true;
    size_t depth = 0;

    void node(uint32_t at, size_t level)
    {
        depth = std::max(depth, level);
        for (size_t c = 0; c < 2; ++c) {
            const glm::uvec4 low = tree.nodes[4 * at + 2 * c];
            const glm::uvec4 high = tree.nodes[4 * at + 2 * c + 1];
            if (high.w == 0) node(low.w, level + 1);
            for (uint32_t i = low.w; i < low.w + high.w; ++i)
                triangle(i, {vectorOf(low), vectorOf(high)});
        }
    }

    void triangle(uint32_t i, const Bounds& box)
    {
        facets.push_back(tree.triangles[3 * i].w);
        const glm::vec3 first = vectorOf(tree.triangles[3 * i]);
        for (const glm::vec3 way : {glm::vec3(0.0f), vectorOf(tree.triangles[3 * i + 1]),
                                    vectorOf(tree.triangles[3 * i + 2])})
            isInside = isInside && Bounds{box.low - 1e-5f, box.high + 1e-5f}.contains(first + way);
    }
};

} // namespace

TEST(RayTree, HasEveryTriangleOnceWithinItsBoxes)
{
    std::vector<scenes::Panel> panels;
    for (int i = 0; i < 60; ++i) {
        const auto walls = scenes::wallsOf(glm::vec3(0.1f * static_cast<float>(i + 1)));
        panels.insert(panels.end(), walls.begin(), walls.end());
    }
    const Scan scan = scenes::panels(panels, 4, scenes::plain(glm::vec3(0.5f)));
    const RayTree tree(scan);
    Walk walk{tree, {}};
    walk.node(0, 1);
    std::sort(walk.facets.begin(), walk.facets.end());
    ASSERT_EQ(walk.facets.size(), scan.triangleCount());
    for (uint32_t i = 0; i < walk.facets.size(); ++i) EXPECT_EQ(walk.facets[i], i);
    EXPECT_TRUE(walk.isInside);
    EXPECT_LE(walk.depth, RayTree::kMostDepth);
}

// A square is two triangles, which fit one leaf.
TEST(RayTree, OfOneLeafHasARootAllTheSame)
{
    const RayTree tree(scenes::square(1.0f, 4, scenes::plain(glm::vec3(0.5f))));
    Walk walk{tree, {}};
    walk.node(0, 1);
    EXPECT_GE(walk.facets.size(), 2u);
    EXPECT_TRUE(walk.isInside);
}

} // namespace relamp
