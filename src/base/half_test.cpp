#include "base/half.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace relamp
{

TEST(Half, EveryNormalHalfSurvivesTheWayThroughFloat)
{
    for (uint32_t bits = 0x400; bits < 0x7c00; ++bits)
        ASSERT_EQ(halfFromFloat(floatFromHalf(static_cast<uint16_t>(bits))), bits);
}

TEST(Half, RoundsToWithinHalfAStep)
{
    for (float v = 1e-4f; v < 6e4f; v *= 1.0007f)
        ASSERT_NEAR(floatFromHalf(halfFromFloat(v)), v, v / 2048.0f);
}

TEST(Half, NeverMakesInfinityOrNan)
{
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(floatFromHalf(halfFromFloat(kInfinity)), kLargestHalf);
    EXPECT_EQ(floatFromHalf(halfFromFloat(std::numeric_limits<float>::quiet_NaN())), kLargestHalf);
    EXPECT_EQ(floatFromHalf(halfFromFloat(1e10f)), kLargestHalf);
    EXPECT_EQ(floatFromHalf(halfFromFloat(0.0f)), 0.0f);
    EXPECT_EQ(floatFromHalf(halfFromFloat(1e-9f)), 0.0f);
}

} // namespace relamp
