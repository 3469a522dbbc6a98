#include "image/light_meter.h"

#include "base/half.h"

#include <vector>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

/// A row of grey pixels.
Image greys(const std::vector<float>& light)
{
    Image picture{.width = static_cast<int>(light.size()), .height = 1};
    auto& half = picture.rgb.emplace<std::vector<uint16_t>>();
    for (const float grey : light) half.insert(half.end(), 3, halfFromFloat(grey));
    return picture;
}

float exposureOf(const std::vector<float>& light)
{
    LightMeter meter;
    meter.add(greys(light));
    return meter.exposure();
}

} // namespace

TEST(LightMeter, AGreyCardIsExposedToMiddleGrey)
{
    EXPECT_NEAR(exposureOf({0.18f, 0.18f}), 0.0f, 0.01f);
    EXPECT_NEAR(exposureOf({0.09f}), 1.0f, 0.01f); // half the light, a stop more
    EXPECT_NEAR(exposureOf({1.44f}), -3.0f, 0.01f);
}

// Else a lamp in the picture, which has most of its light, would make all else black.
TEST(LightMeter, StopsAreAveragedNotLight)
{
    EXPECT_NEAR(exposureOf({0.18f * 8.0f, 0.18f / 8.0f}), 0.0f, 0.01f);
}

TEST(LightMeter, BlackDoesNotCountAndAllBlackIsLeftAsItIs)
{
    EXPECT_FLOAT_EQ(exposureOf({0.09f, 0.0f, 0.0f}), exposureOf({0.09f}));
    EXPECT_EQ(exposureOf({0.0f}), 0.0f);
    EXPECT_EQ(LightMeter().exposure(), 0.0f);
}

TEST(LightMeter, PicturesOfAFilmCountAlike)
{
    LightMeter meter;
    meter.add(greys({0.18f}));
    meter.add(greys({0.72f}));
    EXPECT_NEAR(meter.exposure(), -1.0f, 0.01f);
}

} // namespace relamp
