#include "albedo/divide.h"

#include "albedo/divide.shared.h"
#include "base/half.h"
#include "base/radiometry.shared.h"

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

TEST(Divide, NothingIsWhiterThanPaperAndItsHueIsKept)
{
    TexelBlock block;
    block.count = 1;
    block.r[0] = 0.6f;
    block.g[0] = 0.4f;
    block.b[0] = 0.2f;
    ShadingBlock shading{};
    for (float* channel : {shading.direct.r, shading.direct.g, shading.direct.b}) channel[0] = 0.5f;
    AlbedoBlock albedo{};
    divide(block, shading, 0.02f, albedo);
    EXPECT_NEAR(floatFromHalf(albedo.r[0]), 0.87f, 1e-3f);
    EXPECT_NEAR(floatFromHalf(albedo.g[0]), kWhitePaint * 2.0f / 3.0f, 1e-3f);
    EXPECT_NEAR(floatFromHalf(albedo.b[0]), kWhitePaint / 3.0f, 1e-3f);
    EXPECT_NEAR(floatFromHalf(albedo.r[0]) * albedo.lack[0] * 0.5f, block.r[0], 1e-3f);
}

TEST(Divide, WhatGetsNoLightIsUsualPaper)
{
    EXPECT_NEAR(divideOne(0.0f, 0.0f, 0.0f), kUsualPaper, 1e-3f);
}

TEST(Divide, ShadingIsBelievedTheLessTheDarkerItIs)
{
    const float paper = 0.8f;
    EXPECT_NEAR(divideOne(0.02f * paper, 0.02f, 0.0f), paper, 1e-3f);
    EXPECT_NEAR(divideOne(0.015f * paper, 0.015f, 0.0f), 0.6f, 1e-3f); // as if by 0.02
    EXPECT_NEAR(divideOne(0.01f * 0.1f, 0.01f, 0.0f), 0.75f * 0.1f + 0.25f * kUsualPaper, 1e-3f);
}

TEST(Divide, WhatShowsWithoutLightIsDividedByTheDarkestShading)
{
    EXPECT_NEAR(divideOne(0.05f, 0.0f, 0.0f, 0.1f), 0.5f, 1e-3f);
}

// What a warm lamp hardly reaches is no bluer for that; only a channel without any light is noise.
TEST(Divide, DarkShadingIsRaisedInItsOwnHue)
{
    const glm::vec3 shading(0.005f, 0.003f, 0.0f);
    const glm::vec3 albedo = dividedByShading(0.3f * shading, shading, 0.02f);
    EXPECT_NEAR(albedo.r, albedo.g, 1e-3f);
    EXPECT_NEAR(albedo.r, 0.3f, 0.04f);
    EXPECT_LT(albedo.b, albedo.g);
}

} // namespace relamp
