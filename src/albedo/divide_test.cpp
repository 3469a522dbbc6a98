#include "albedo/divide.h"

#include "albedo/confidence.h"
#include "base/half.h"

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

float divideOne(float radiance, float direct, float indirect, float darkest = 0.02f)
{
    TexelBlock block;
    block.count = 1;
    block.r[0] = radiance;
    ShadingBlock shading{};
    shading.direct.r[0] = direct;
    shading.indirect.r[0] = indirect;
    AlbedoBlock albedo{};
    divide(block, shading, darkest, albedo);
    return floatFromHalf(albedo.r[0]);
}

} // namespace

TEST(Divide, GivesBackTheAlbedoOfALitSurface)
{
    EXPECT_NEAR(divideOne(0.35f * 1.5f, 1.0f, 0.5f), 0.35f, 1e-3f);
}

TEST(Divide, NeverDividesByLessThanTheDarkestShading)
{
    EXPECT_NEAR(divideOne(0.01f, 0.0f, 0.0f, 0.1f), 0.1f, 1e-3f);
}

TEST(Confidence, IsLostWhereTheTextureIsBurntOutOrUnlit)
{
    const glm::vec3 lit(1.0f);
    EXPECT_EQ(confidence(glm::vec3(1.0f), true, lit, 0.02f), 0.0f);
    EXPECT_EQ(confidence({0.99f, 0.2f, 0.2f}, true, lit, 0.02f), 0.0f); // one channel is enough
    EXPECT_EQ(confidence(glm::vec3(0.01f), true, glm::vec3(0.015f), 0.02f), 0.0f);
    EXPECT_EQ(confidence(glm::vec3(0.5f), true, lit, 0.02f), 1.0f);
    EXPECT_EQ(confidenceByte(1.0f), 255);
}

// A float texture says how bright its brightest is.
TEST(Confidence, IsKeptAboveWhiteWhereTheTextureDoesNotClip)
{
    EXPECT_EQ(confidence(glm::vec3(7.0f), false, glm::vec3(9.0f), 0.02f), 1.0f);
    EXPECT_EQ(confidence(glm::vec3(7.0f), false, glm::vec3(0.01f), 0.02f), 0.0f);
}

} // namespace relamp
