#include "image/padding.h"

#include "base/half.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr int kPageSize = 64;

/// Red on the left, green on the right, with an uncovered band of `band` pixels between.
struct TwoCharts
{
    explicit TwoCharts(int band)
        : rgb(3 * kPageSize * kPageSize, 0), covered(kPageSize * kPageSize, 0)
    {
        for (int y = 0; y < kPageSize; ++y)
            for (int x = 0; x < kPageSize; ++x) {
                const bool left = x < kPageSize / 2 - band / 2;
                const bool right = x >= kPageSize / 2 + band / 2;
                const auto i = static_cast<size_t>(y * kPageSize + x);
                covered[i] = left || right;
                if (left) rgb[3 * i] = halfFromFloat(1.0f);
                if (right) rgb[3 * i + 1] = halfFromFloat(1.0f);
            }
    }
    std::vector<uint16_t> rgb;
    std::vector<uint8_t> covered;
};

} // namespace

TEST(Padding, CoveredPixelsStayAsTheyAre)
{
    TwoCharts charts(8);
    const auto before = charts.rgb;
    fillPadding(std::span(charts.rgb), charts.covered, kPageSize, kPageSize);
    for (size_t i = 0; i < charts.covered.size(); ++i)
        if (charts.covered[i]) {
            EXPECT_EQ(charts.rgb[3 * i], before[3 * i]);
        }
}

TEST(Padding, PixelsNextToAChartContinueIt)
{
    TwoCharts charts(16);
    fillPadding(std::span(charts.rgb), charts.covered, kPageSize, kPageSize);
    const size_t row = 30 * kPageSize;
    EXPECT_EQ(floatFromHalf(charts.rgb[3 * (row + 24)]), 1.0f); // first uncovered pixel: all red
    EXPECT_EQ(floatFromHalf(charts.rgb[3 * (row + 24) + 1]), 0.0f);
    EXPECT_EQ(floatFromHalf(charts.rgb[3 * (row + 39) + 1]), 1.0f); // last: all green
}

// Every mip level of the filled picture is as bright as its covered pixels: no black creeps in.
TEST(Padding, NoMipLevelIsDarkerThanTheCharts)
{
    TwoCharts charts(30);
    fillPadding(std::span(charts.rgb), charts.covered, kPageSize, kPageSize);
    std::vector<float> level(kPageSize * kPageSize);
    for (size_t i = 0; i < level.size(); ++i)
        level[i] = floatFromHalf(charts.rgb[3 * i]) + floatFromHalf(charts.rgb[3 * i + 1]);
    for (size_t size = kPageSize; size > 1; size /= 2) {
        std::vector<float> next(size * size / 4);
        for (size_t y = 0; y < size / 2; ++y)
            for (size_t x = 0; x < size / 2; ++x)
                next[y * size / 2 + x] =
                    0.25f *
                    (level[2 * y * size + 2 * x] + level[2 * y * size + 2 * x + 1] +
                     level[(2 * y + 1) * size + 2 * x] + level[(2 * y + 1) * size + 2 * x + 1]);
        level = next;
        for (const float v : level) EXPECT_NEAR(v, 1.0f, 0.01f);
    }
}

TEST(Padding, AnEmptyPictureStaysEmpty)
{
    std::vector<uint16_t> rgb(3 * 7 * 5, 0);
    const std::vector<uint8_t> covered(7 * 5, 0);
    fillPadding(std::span(rgb), covered, 7, 5);
    EXPECT_TRUE(std::all_of(rgb.begin(), rgb.end(), [](uint16_t v) { return v == 0; }));
}

} // namespace relamp
