#include "shading/area_direct.h"

#include "shading/lamp_patches.h"

#include "scenes/axes.h"
#include "scenes/radiosity.h"
#include "scenes/surfaces.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::kDown;
using scenes::kUp;

constexpr float kOffPlace = 2e-3f; // m; shadow rays start so far off

/// Of `side` squared, `height` above the origin, facing down.
scenes::Panel above(float height, float side)
{
    return {{-0.5f * side, height, -0.5f * side}, {side, 0, 0}, {0, 0, side}};
}

float openAt(const AreaLight& light, glm::vec3 place, glm::vec3 normal,
             Geometry geometry = Geometry::exact)
{
    TexelBlock block;
    scenes::addTexel(block, place, normal);
    float irradiance[TexelBlock::kPadded];
    openIrradiance(block, LampPatches(light), geometry, irradiance);
    return irradiance[0];
}

/// A floor, and a square that hovers over its middle.
Scan floorAndTable()
{
    const scenes::Panel parts[] = {{{-2, 0, -2}, {0, 0, 4}, {4, 0, 0}},
                                   {{-0.5f, 1, -0.5f}, {0, 0, 1}, {1, 0, 0}}};
    return scenes::panels(parts, 16, scenes::plain(glm::vec3(0.5f)));
}

} // namespace

TEST(AreaDirect, SmallPatchFallsOffWithTheSquareOfTheDistance)
{
    const float area = 1e-4f;
    for (const float height : {0.5f, 1.0f, 4.0f})
        EXPECT_NEAR(openAt(scenes::lightOf(above(height, 0.01f), 1), glm::vec3(0.0f), kUp),
                    area / (height * height), 1e-3f * area / (height * height));
}

TEST(AreaDirect, FollowsTheCosineAtBothEndsAndIsDarkBehind)
{
    const float half = std::sqrt(0.5f);
    const AreaLight light = scenes::lightOf(above(1.0f, 0.01f), 1);
    EXPECT_NEAR(openAt(light, glm::vec3(0.0f), {half, half, 0}), 1e-4f * half, 1e-7f);
    // 45 degrees off: a cosine at the lamp, one at the floor, twice the distance squared
    EXPECT_NEAR(openAt(light, {1, 0, 0}, kUp), 1e-4f * 0.25f, 1e-7f);
    EXPECT_EQ(openAt(light, glm::vec3(0.0f), kDown), 0.0f);
    EXPECT_EQ(openAt(light, {0, 2, 0}, kDown), 0.0f);
}

// What bends to a panel in its plane is lit by it all the same, by cos cos' / d^2.
TEST(AreaDirect, WhatFacesAlikeIsLitByItsTilt)
{
    const AreaLight panel = scenes::lightOf(above(2.5f, 0.01f), 1);
    const float tilt = 0.035f;                                 // 2 degrees
    const glm::vec3 bent(-std::sin(tilt), -std::cos(tilt), 0); // towards the panel
    for (const float distance : {0.3f, 1.0f, 4.0f}) {
        const glm::vec3 way(-distance, 0.005f, 0); // half a centimetre below
        const float squared = glm::dot(way, way);
        const float exact = 1e-4f * glm::dot(way, bent) * way.y / (squared * squared);
        EXPECT_NEAR(openAt(panel, glm::vec3(0, 2.5f, 0) - way, bent), exact, 5e-3f * exact);
    }
}

// Irradiance of radiance 1 from a square: Lambert's formula is exact.
TEST(AreaDirect, LargePanelLightsByItsFormFactor)
{
    const scenes::Panel panel = above(1.0f, 2.0f);
    const AreaLight light = scenes::lightOf(panel, 16);
    for (const glm::vec3 place : {glm::vec3(0.0f), glm::vec3(1, 0, 0.3f), glm::vec3(3, 0.5f, 0)}) {
        const float exact = scenes::irradianceFrom(panel, place, kUp);
        EXPECT_NEAR(openAt(light, place, kUp), exact, 0.01f * exact);
    }
}

// The tree of patches over texels and many samples with shadow rays are one light.
TEST(AreaDirect, PatchesAndSamplesAgree)
{
    const scenes::Surfaces far(scenes::square(1.0f, 8, scenes::plain(glm::vec3(0.5f))));
    const AreaLight light = scenes::lightOf(above(4.0f, 1.0f), 8);
    std::mt19937 random(1);
    const auto number = [&] { return static_cast<float>(random() % 1000) / 1000.0f; };
    TexelBlock block;
    for (size_t i = 0; i < 101; ++i)
        scenes::addTexel(block, {4.0f * number(), number(), 4.0f * number()},
                         glm::normalize(glm::vec3(number(), 1.0f, number())));
    float open[TexelBlock::kPadded];
    openIrradiance(block, LampPatches(light), Geometry::exact, open);
    for (size_t i = 0; i < block.count; ++i) {
        const glm::vec3 normal(block.nx[i], block.ny[i], block.nz[i]);
        const glm::vec3 place(block.x[i], block.y[i], block.z[i]);
        const AreaSample sample =
            sampleAreaLight(far.rays, light, place - kOffPlace * normal, normal, 4096, 0.5f);
        EXPECT_NEAR(open[i], sample.open, 1e-2f * sample.open + 5e-4f); // of 0.06 at most
    }
}

TEST(AreaDirect, ShadowIsWhatStandsBetween)
{
    const scenes::Surfaces scene(floorAndTable());
    const AreaLight light = scenes::lightOf(above(3.0f, 0.2f), 4);
    const auto sampleAt = [&](glm::vec3 place) {
        return sampleAreaLight(scene.rays, light, place, kUp, 16, 0.5f);
    };
    EXPECT_GT(sampleAt({0, 0, 0}).open, 0.0f);
    EXPECT_EQ(sampleAt({0, 0, 0}).visible, 0.0f);
    EXPECT_EQ(sampleAt({1.5f, 0, 0}).visible, sampleAt({1.5f, 0, 0}).open);
    EXPECT_EQ(sampleAt({0, 1, 0}).visible, sampleAt({0, 1, 0}).open);
    // the ray from the centre of the lamp over the edge of the table ends here: 0.5 m * 3 / 2
    const AreaSample edge = sampleAt({0.75f, 0, 0});
    EXPECT_NEAR(edge.visible / edge.open, 0.5f, 0.15f);
}

} // namespace relamp
