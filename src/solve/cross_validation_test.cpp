#include "fit/cross_validation.h"

#include "base/half.h"
#include "base/radiometry.shared.h"
#include "base/random.h"
#include "base/sampling.shared.h"
#include "fit/held_out.h"
#include "relamp/delight.h"
#include "scenes/lit_room.h"
#include "scenes/surfaces.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::LitRoom;
using testing::Contains;
using testing::HasSubstr;

constexpr float kFloorSide = 8.0f;

/// Light of a lamp 1.5 m above the middle of a floor, and some from all around; shading.
glm::vec3 shadingAt(glm::vec3 place)
{
    const float d2 =
        1.5f * 1.5f + (place.x - 4.0f) * (place.x - 4.0f) + (place.z - 4.0f) * (place.z - 4.0f);
    return glm::vec3(0.4f, 0.36f, 0.3f) * (2.0f * 1.5f / (d2 * std::sqrt(d2)) + 0.1f);
}

/// A floor in that light, with its witnesses.
struct WitnessedFloor
{
    scenes::Surfaces surfaces;
    Witnesses witnesses;

    explicit WitnessedFloor(const scenes::Paint& albedo, float side = kFloorSide)
        : surfaces(scenes::square(
              side, 512, [&](glm::vec3 p, glm::vec3 n) { return albedo(p, n) * shadingAt(p); })),
          witnesses(witnessesOf(surfaces.texels.surfels, surfaces.radiance))
    {}

    [[nodiscard]] std::vector<glm::vec3> shading(float power = 1.0f) const
    {
        std::vector<glm::vec3> shading;
        for (const uint32_t s : witnesses.surfels) {
            const glm::vec3 found = shadingAt(surfaces.texels.surfels.position[s]);
            shading.push_back(glm::pow(found, glm::vec3(power)));
        }
        return shading;
    }
    [[nodiscard]] CrossValidation under(const std::vector<glm::vec3>& light) const
    {
        return crossValidate(witnesses, light, temperingFor(witnesses, light));
    }
};

glm::vec3 greyPaint(glm::vec3, glm::vec3)
{
    return glm::vec3(0.5f);
}

/// Tiles of two paints of one hue, 0.25 m wide, as chance has it: of half of all pairs.
glm::vec3 twoPaints(glm::vec3 place, glm::vec3)
{
    const auto tile =
        static_cast<uint64_t>(place.x * 4.0f) * 1000 + static_cast<uint64_t>(place.z * 4.0f);
    return glm::vec3(Random(5, 6, tile).next() < 0.5f ? 0.8f : 0.2f);
}

} // namespace

TEST(CrossValidation, LooksAtNothingThatIsFitted)
{
    const WitnessedFloor floor(greyPaint);
    const Surfels& surfels = floor.surfaces.texels.surfels;
    const HeldOut heldOut(surfels.seed);
    ASSERT_GT(floor.witnesses.pairs.size(), 1000u);
    for (const uint32_t s : floor.witnesses.surfels) EXPECT_TRUE(heldOut.has(surfels.position[s]));
    for (const auto& [p, q] : floor.witnesses.pairs)
        EXPECT_GE(glm::distance(surfels.position[floor.witnesses.surfels[p]],
                                surfels.position[floor.witnesses.surfels[q]]),
                  0.5f);
}

TEST(CrossValidation, RightLightLeavesOnePaintEven)
{
    const WitnessedFloor floor(greyPaint);
    const CrossValidation found = floor.under(floor.shading());
    EXPECT_GT(found.scan, 0.2f);
    EXPECT_LT(found.albedo, 0.03f);
    EXPECT_EQ(found.shadingPower, 1.0f);
    EXPECT_TRUE(found.improves);
    EXPECT_TRUE(warningsOf(found).empty());
}

// By their median, paints that differ by two stops would hide all that light does.
TEST(CrossValidation, HalfOfAllPairsMayBeOfTwoPaints)
{
    const WitnessedFloor floor(twoPaints);
    const CrossValidation found = floor.under(floor.shading());
    EXPECT_GT(found.scan, 0.2f);
    EXPECT_LT(found.albedo, 0.5f * found.scan);
    EXPECT_EQ(found.shadingPower, 1.0f);
}

// Light that is twice as contrasty as it should be is right to the power of one half.
TEST(CrossValidation, LightThatIsTooStrongIsBelievedByHalf)
{
    const WitnessedFloor floor(greyPaint);
    const CrossValidation found = floor.under(floor.shading(2.0f));
    EXPECT_NEAR(found.shadingPower, 0.5f, 1e-6f);
    EXPECT_LT(found.albedo, 0.03f);
    EXPECT_THAT(warningsOf(found), Contains(HasSubstr("to the power of 0.5")));
}

// Nothing that the shading could be taken to helps where it is bright for dark.
TEST(CrossValidation, LightThatIsUpsideDownIsNotBelieved)
{
    const WitnessedFloor floor(greyPaint);
    const CrossValidation found = floor.under(floor.shading(-1.0f));
    EXPECT_EQ(found.shadingPower, 0.0f);
    EXPECT_EQ(found.albedo, found.scan);
    EXPECT_FALSE(found.improves);
    EXPECT_THAT(warningsOf(found), Contains(HasSubstr("no better than the scan")));
}

// Noise of light by a tenth of a stop, as of few rays, is nothing to tell a power by.
TEST(CrossValidation, NoisyLightIsBelieved)
{
    const WitnessedFloor floor(twoPaints);
    std::vector<glm::vec3> light = floor.shading();
    Random random(1, 2, 3);
    for (glm::vec3& l : light) l *= std::exp2(0.35f * (random.next() - 0.5f));
    const CrossValidation found = floor.under(light);
    EXPECT_EQ(found.shadingPower, 1.0f);
    EXPECT_TRUE(found.improves);
}

// Nothing much gets brighter, which whiter than paper it could be: nine in ten get darker.
TEST(CrossValidation, WhatIsBrightestLitKeepsItsAlbedo)
{
    const WitnessedFloor floor(greyPaint);
    const std::vector<glm::vec3> light = floor.shading(2.0f);
    const Tempering tempering = temperingFor(floor.witnesses, light);
    const auto below = std::count_if(light.begin(), light.end(),
                                     [&](glm::vec3 l) { return l.g < tempering.kept.g; });
    EXPECT_NEAR(static_cast<double>(below) / static_cast<double>(light.size()), 0.9, 0.01);
}

TEST(CrossValidation, SaysNothingOfAScanThatIsTooSmall)
{
    const WitnessedFloor floor(greyPaint, 0.6f);
    const CrossValidation found = floor.under(floor.shading(2.0f));
    EXPECT_EQ(found.pairs, 0u);
    EXPECT_EQ(found.shadingPower, 1.0f);
    EXPECT_TRUE(warningsOf(found).empty());
}

TEST(CrossValidation, OfARoomWhoseLampIsFoundImproves)
{
    const Decomposition room = delight(LitRoom().scan);
    const CrossValidation& found = room.crossValidation();
    EXPECT_GT(found.pairs, 1000u);
    EXPECT_LT(found.albedo, 0.3f * found.scan);
    EXPECT_LT(found.chromaOfAlbedo, found.chromaOfScan);
    EXPECT_EQ(found.shadingPower, 1.0f);
}

/// A room whose panel is said to be off, and a lamp on its floor to shine at the ceiling.
Decomposition litWrongly(const Scan& scan)
{
    Lights lights = delight(scenes::copyOf(scan)).lights();
    lights.fixtures[0].radiance = glm::vec3(0.0f);
    lights.points.clear();
    lights.fixtures.push_back({.centre = {2.5f, 0.05f, 2.5f},
                               .normal = {0, 1, 0},
                               .area = 0.1f,
                               .radiance = glm::vec3(400.0f)});
    return delight(scenes::copyOf(scan), {.lights = lights});
}

// What is in the shade of a lamp that is not there is as even as it was, and hides the rest from a
// quartile.
TEST(CrossValidation, LightThatIsWrongAtFewPlacesDoesNotImproveTheScan)
{
    const WitnessedFloor floor(greyPaint);
    std::vector<glm::vec3> light = floor.shading();
    for (size_t i = 0; i < light.size(); ++i)
        if (floor.surfaces.texels.surfels.position[floor.witnesses.surfels[i]].x < 2.5f)
            light[i] *= std::exp2(10.0f * hashedShift(static_cast<uint>(i), 3));
    const CrossValidation found = crossValidate(floor.witnesses, light, {});
    EXPECT_LT(found.albedo, 0.1f * found.scan);
    EXPECT_FALSE(found.improves);
    EXPECT_THAT(warningsOf(found), Contains(HasSubstr("more of them by much")));
}

TEST(CrossValidation, LightThatIsGivenWrongIsNotBelievedAndThePersonIsTold)
{
    const LitRoom room;
    const Decomposition result = litWrongly(room.scan);
    EXPECT_LT(result.crossValidation().shadingPower, 0.8f);
    EXPECT_THAT(result.warnings(), Contains(HasSubstr("--lights")));
    const PageLayers layers = result.layers(0);
    for (const uint8_t confidence : layers.confidence) ASSERT_LE(confidence, 102); // 0.4
    EXPECT_GT(layers.area[static_cast<size_t>(Doubt::unproven)], 1.0);
}

// What is written as shading is what the texture was divided by, whatever the power.
TEST(CrossValidation, ShadingTimesAlbedoIsTheTextureAllTheSame)
{
    const LitRoom room;
    const Decomposition result = litWrongly(room.scan);
    ASSERT_LT(result.crossValidation().shadingPower, 1.0f);
    const PageLayers layers = result.layers(0);
    const Radiance radiance(room.scan.pages[0].image);
    Progress progress;
    const Texels texels = rasterizeAtlas(room.scan, progress);
    const auto at = [](const std::vector<uint16_t>& layer, uint32_t pixel, int c) {
        return floatFromHalf(layer[3 * size_t{pixel} + static_cast<size_t>(c)]);
    };
    size_t compared = 0;
    for (const uint32_t pixel : texels.pages[0].pixel) {
        const glm::vec3 shown = radiance[pixel];
        const glm::vec3 total(at(layers.direct, pixel, 0) + at(layers.indirect, pixel, 0),
                              at(layers.direct, pixel, 1) + at(layers.indirect, pixel, 1),
                              at(layers.direct, pixel, 2) + at(layers.indirect, pixel, 2));
        const float darkest = std::min({total.r, total.g, total.b});
        if (std::max({shown.r, shown.g, shown.b}) > 0.9f || darkest < 0.05f) continue;
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(at(layers.albedo, pixel, c) * total[c], shown[c], 0.005f * shown[c]);
        ++compared;
    }
    EXPECT_GT(compared, 10'000u);
}

} // namespace relamp
