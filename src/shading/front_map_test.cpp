#include "shading/front_map.h"

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr uint32_t kWidth = 10;
constexpr uint32_t kHeight = 7;

/// A map of a page whose every pixel shows a front of its own.
FrontMap mapBySquaresOf(uint32_t side)
{
    FrontMap map(kWidth, kHeight, side);
    for (uint32_t pixel = 0; pixel < kWidth * kHeight; ++pixel)
        map.put(pixel, HitTarget::of(Side::front(pixel), false));
    return map;
}

uint32_t surfelAt(const FrontMap& map, uint32_t column, uint32_t row)
{
    return map.at(row * kWidth + column).side().surfel();
}

TEST(FrontMap, HasAllPixelsWhereSquaresAreOnePixel)
{
    const FrontMap map = mapBySquaresOf(1);
    for (uint32_t pixel = 0; pixel < kWidth * kHeight; ++pixel)
        EXPECT_EQ(map.at(pixel).side().surfel(), pixel);
}

TEST(FrontMap, HasTheMiddleOfALargerSquare)
{
    const FrontMap map = mapBySquaresOf(3);
    for (const auto& [column, row] : {std::pair{0u, 0u}, {2u, 1u}, {1u, 2u}})
        EXPECT_EQ(surfelAt(map, column, row), 1 * kWidth + 1);
    EXPECT_EQ(surfelAt(map, 5, 3), 4 * kWidth + 4);
}

TEST(FrontMap, HasNothingWhereTheMiddleIsNotThere)
{
    const FrontMap map = mapBySquaresOf(3); // the last column and row are the first of squares
    EXPECT_TRUE(map.at(6 * kWidth + 9).isNothing());
    EXPECT_TRUE(map.at(9).isNothing());
}

} // namespace
} // namespace relamp
