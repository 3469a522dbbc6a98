#include "thesis/median_cut.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

/// An image in the plane z = 0, one point a pixel at (column, row).
std::vector<CutPoint> image(const std::vector<std::vector<float>>& rows)
{
    std::vector<CutPoint> points;
    for (size_t y = 0; y < rows.size(); ++y)
        for (size_t x = 0; x < rows[y].size(); ++x)
            points.push_back({{static_cast<float>(x), static_cast<float>(y), 0.0f}, rows[y][x]});
    return points;
}

std::set<uint32_t> asSet(const std::vector<uint32_t>& region)
{
    return {region.begin(), region.end()};
}

float energyOf(const std::vector<CutPoint>& points, const std::vector<uint32_t>& region)
{
    float sum = 0.0f;
    for (const uint32_t i : region) sum += points[i].energy;
    return sum;
}

} // namespace

// Debevec's own steps on an image that can be cut by hand: 4 x 2 pixels, first across the longer
// side where the energy is halved (8 | 8), then each half across its own longer side.
TEST(MedianCut, GivesDebevecsRegionsOnAKnownImage)
{
    const auto points = image({{5, 1, 1, 1}, {1, 1, 1, 5}});
    const auto halves = medianCut(points, 1);
    ASSERT_EQ(halves.size(), 2u);
    EXPECT_EQ(asSet(halves[0]), (std::set<uint32_t>{0, 1, 4, 5})); // columns 0 and 1
    EXPECT_EQ(asSet(halves[1]), (std::set<uint32_t>{2, 3, 6, 7}));

    const auto wide = image({{5, 1, 1, 1, 4, 4}});
    const auto cuts = medianCut(wide, 2);
    ASSERT_EQ(cuts.size(), 4u);
    EXPECT_EQ(asSet(cuts[0]), (std::set<uint32_t>{0}));       // 5 of 8
    EXPECT_EQ(asSet(cuts[1]), (std::set<uint32_t>{1, 2, 3})); // 3 of 8
    EXPECT_EQ(asSet(cuts[2]), (std::set<uint32_t>{4}));
    EXPECT_EQ(asSet(cuts[3]), (std::set<uint32_t>{5}));
}

TEST(MedianCut, SplitsAcrossTheLongestSideInSpace)
{
    std::vector<CutPoint> points;
    for (int i = 0; i < 8; ++i)
        points.push_back({{0.1f * static_cast<float>(i % 2), 0.0f, static_cast<float>(i)}, 1.0f});
    const auto halves = medianCut(points, 1);
    EXPECT_EQ(asSet(halves[0]), (std::set<uint32_t>{0, 1, 2, 3}));
}

// The point of the cut: every light that comes of it is about equally strong.
TEST(MedianCut, RegionsHaveAboutEqualEnergy)
{
    std::vector<std::vector<float>> rows(32, std::vector<float>(64));
    float total = 0.0f;
    for (size_t y = 0; y < 32; ++y)
        for (size_t x = 0; x < 64; ++x)
            total += rows[y][x] = 1.0f + static_cast<float>((7 * x + 13 * y) % 5);
    const auto points = image(rows);
    for (const auto& region : medianCut(points, 4))
        EXPECT_NEAR(energyOf(points, region), total / 16.0f, 0.15f * total / 16.0f);
}

TEST(MedianCut, KeepsEveryPointOnceHoweverFewThereAre)
{
    const auto points = image({{1, 2, 3}});
    const auto regions = medianCut(points, 6);
    EXPECT_EQ(regions.size(), 3u);
    std::set<uint32_t> seen;
    for (const auto& region : regions) seen.insert(region.begin(), region.end());
    EXPECT_EQ(seen.size(), 3u);
    EXPECT_TRUE(medianCut({}, 6).empty());
}

} // namespace relamp
