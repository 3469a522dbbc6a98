#include "relight/shadow_cells.h"

#include "scenes/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

/// A box of 0.4 m, each of its walls painted with `pixels` x `pixels`.
Scan smallBox(int pixels)
{
    return scenes::room(glm::vec3(0.4f), pixels, scenes::plain(glm::vec3(0.5f)));
}

std::vector<uint32_t> allRuns(const Texels& texels)
{
    std::vector<uint32_t> runs(texels.pages[0].runs.size() - 1);
    std::iota(runs.begin(), runs.end(), 0u);
    return runs;
}

} // namespace

TEST(ShadowCells, HoldEveryTexelOnceAndOfOneFaceAlone)
{
    const Scan scan = smallBox(256);
    Progress progress;
    const Texels texels = rasterizeAtlas(scan, progress);
    const ShadowCells cells(texels, 0, allRuns(texels));
    std::vector<int> held(texels.pages[0].count(), 0);
    for (size_t cell = 0; cell < cells.count(); ++cell) {
        const TexelSite first = texels.siteOf(0, cells.texelsOf(cell).front().index);
        for (const ShadowCells::Texel& texel : cells.texelsOf(cell)) {
            ++held[texel.index];
            EXPECT_EQ(texel.run, texels.pages[0].runOf(texel.index));
            const TexelSite site = texels.siteOf(0, texel.index);
            EXPECT_GT(glm::dot(site.normal, first.normal), 0.7f);
            EXPECT_LT(glm::distance(site.position, first.position), 0.012f);
        }
    }
    EXPECT_EQ(std::ranges::count(held, 1), static_cast<std::ptrdiff_t>(held.size()));
}

// In metres, so that what a shadow costs does not go by its texture.
TEST(ShadowCells, AreAsManyAtAnyFineTexture)
{
    Progress progress;
    std::vector<double> counts;
    for (const int pixels : {133, 267, 533}) { // 3, 1.5 and 0.75 mm
        const Scan scan = smallBox(pixels);
        const Texels texels = rasterizeAtlas(scan, progress);
        counts.push_back(static_cast<double>(ShadowCells(texels, 0, allRuns(texels)).count()));
    }
    EXPECT_NEAR(counts[1] / counts[0], 1.0, 0.1);
    EXPECT_NEAR(counts[2] / counts[0], 1.0, 0.1);
}

TEST(ShadowCells, AreTexelsWhereTheseAreCoarse)
{
    const Scan scan = smallBox(40); // 1 cm
    Progress progress;
    const Texels texels = rasterizeAtlas(scan, progress);
    const ShadowCells cells(texels, 0, allRuns(texels));
    EXPECT_EQ(cells.count(), texels.count());
    uint32_t others[ShadowCells::kAround];
    float weights[ShadowCells::kBetween];
    EXPECT_EQ(cells.around(0, others), 0u);
    EXPECT_EQ(cells.between(0, cells.texelsOf(0).front(), others, weights), 0u);
}

// A linear share comes out as it is: within a wall, the weighted middles are the texel itself.
TEST(ShadowCells, BetweenThemIsInterpolatedLinearly)
{
    const Scan scan = smallBox(256);
    Progress progress;
    const Texels texels = rasterizeAtlas(scan, progress);
    const ShadowCells cells(texels, 0, allRuns(texels));
    std::vector<glm::vec3> middle(cells.count(), glm::vec3(0.0f));
    for (size_t cell = 0; cell < cells.count(); ++cell)
        for (const ShadowCells::Texel& texel : cells.texelsOf(cell))
            middle[cell] += texels.siteOf(0, texel.index).position /
                            static_cast<float>(cells.texelsOf(cell).size());
    size_t within = 0;
    for (size_t cell = 0; cell < cells.count(); ++cell)
        for (const ShadowCells::Texel& texel : cells.texelsOf(cell)) {
            const TexelSite site = texels.siteOf(0, texel.index);
            const glm::vec3 fromMiddle = glm::abs(site.position - 0.2f);
            std::array<float, 3> off{fromMiddle.x, fromMiddle.y, fromMiddle.z};
            std::ranges::sort(off);
            if (off[1] > 0.18f) continue; // at the rim of its wall
            uint32_t between[ShadowCells::kBetween];
            float weights[ShadowCells::kBetween];
            const size_t count = cells.between(cell, texel, between, weights);
            ASSERT_GT(count, 0u);
            glm::vec3 sum(0.0f);
            for (size_t i = 0; i < count; ++i) sum += weights[i] * middle[between[i]];
            EXPECT_LT(glm::distance(sum, site.position), 1e-4f);
            ++within;
        }
    EXPECT_GT(within, texels.count() / 2);
}

} // namespace relamp
