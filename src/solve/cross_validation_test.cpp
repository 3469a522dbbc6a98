#include "solve/cross_validation.h"

#include "base/half.h"
#include "base/radiometry.shared.h"
#include "base/random.h"
#include "base/sampling.shared.h"
#include "relamp/delight.h"
#include "scan/held_out.h"
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
          witnesses(witnessesOf(surfaces.texels.surfels, surfaces.rays, surfaces.radiance.plain,
                                surfaces.radiance, {}, Quality::standard))
    {}

    [[nodiscard]] glm::vec3 placeOf(uint32_t witness) const
    {
        return surfaces.texels.surfels.position[witnesses.surfels[witness]];
    }
    /// Of all surfels.
    [[nodiscard]] std::vector<glm::vec3> irradiance(float power = 1.0f) const
    {
        std::vector<glm::vec3> irradiance;
        for (const glm::vec3 place : surfaces.texels.surfels.position)
            irradiance.push_back(kPi * glm::pow(shadingAt(place), glm::vec3(power)));
        return irradiance;
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

// Of what a fit that leaves out their fold did not look at.
TEST(CrossValidation, PairsAreOfOneFoldAndFarApart)
{
    const WitnessedFloor floor(greyPaint);
    const uint32_t seed = floor.surfaces.texels.surfels.seed;
    ASSERT_GT(floor.witnesses.pairs.size(), 1000u);
    for (const auto& [p, q] : floor.witnesses.pairs) {
        EXPECT_EQ(foldOf(floor.placeOf(p), seed), foldOf(floor.placeOf(q), seed));
        EXPECT_GE(glm::distance(floor.placeOf(p), floor.placeOf(q)), 0.5f);
    }
}

TEST(CrossValidation, RightLightLeavesOnePaintEven)
{
    const WitnessedFloor floor(greyPaint);
    const CrossValidation found = floor.under(floor.irradiance());
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
    const CrossValidation found = floor.under(floor.irradiance());
    EXPECT_GT(found.scan, 0.2f);
    EXPECT_LT(found.albedo, 0.5f * found.scan);
    EXPECT_EQ(found.shadingPower, 1.0f);
}

// Light that is twice as contrasty as it should be is right to the power of one half.
TEST(CrossValidation, LightThatIsTooStrongIsBelievedByHalf)
{
    const WitnessedFloor floor(greyPaint);
    const CrossValidation found = floor.under(floor.irradiance(2.0f));
    EXPECT_NEAR(found.shadingPower, 0.5f, 1e-6f);
    EXPECT_LT(found.albedo, 0.03f);
    EXPECT_THAT(warningsOf(found), Contains(HasSubstr("to the power of 0.5")));
}

// Nothing that the shading could be taken to helps where it is bright for dark.
TEST(CrossValidation, OfLightThatIsUpsideDownTheScanIsLeft)
{
    const WitnessedFloor floor(greyPaint);
    const CrossValidation found = floor.under(floor.irradiance(-1.0f));
    EXPECT_EQ(found.shadingPower, 0.0f);
    EXPECT_EQ(found.albedo, found.scan);
    EXPECT_EQ(found.gain(), 0.0f);
    EXPECT_FALSE(found.improves);
    EXPECT_THAT(warningsOf(found), testing::ElementsAre(HasSubstr("the scan itself")));
}

// A curve that is undone where there was none makes light of paint, and what was even uneven.
TEST(CrossValidation, TheScanIsWhatItWasWithoutTheCamera)
{
    const WitnessedFloor floor(twoPaints);
    Witnesses bent = floor.witnesses;
    for (glm::vec3& radiance : bent.radiance) radiance = glm::pow(radiance, glm::vec3(2.0f));
    const CrossValidation straight =
        crossValidate(floor.witnesses, floor.irradiance(), {glm::vec3(1.0f), 1.0f});
    const CrossValidation found = crossValidate(bent, floor.irradiance(), {glm::vec3(1.0f), 1.0f});
    EXPECT_EQ(found.scan, straight.scan);
    EXPECT_GT(found.albedo, 2.0f * straight.albedo);
}

// What a fit knew of places by looking at them is taken from the albedo that is measured.
TEST(CrossValidation, CountsWhatOnlyAFitThatLooksKnows)
{
    const WitnessedFloor floor(greyPaint);
    Witnesses unseen = floor.witnesses;
    for (size_t i = 0; i < unseen.unseen.size(); ++i)
        unseen.unseen[i] = hashedShift(static_cast<uint>(i), 3); // 0..1
    const std::vector<glm::vec3> light = floor.irradiance();
    EXPECT_LT(crossValidate(floor.witnesses, light, {}).albedo, 0.03f);
    // A quarter of the differences of two numbers of 0..1 is below 1 - sqrt(3/4).
    EXPECT_NEAR(crossValidate(unseen, light, {}).albedo, 0.134f / std::log(2.0f), 0.02f);
}

// Noise of light by a tenth of a stop, as of few rays, is nothing to tell a power by.
TEST(CrossValidation, NoisyLightIsBelieved)
{
    const WitnessedFloor floor(twoPaints);
    std::vector<glm::vec3> light = floor.irradiance();
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
    const std::vector<glm::vec3> light = floor.irradiance(2.0f);
    const Tempering tempering = temperingFor(floor.witnesses, light);
    const std::vector<uint32_t>& surfels = floor.witnesses.surfels;
    const auto below = std::count_if(surfels.begin(), surfels.end(), [&](uint32_t s) {
        return light[s].g < kPi * tempering.kept.g;
    });
    EXPECT_NEAR(static_cast<double>(below) / static_cast<double>(surfels.size()), 0.9, 0.01);
}

TEST(CrossValidation, SaysNothingOfAScanThatIsTooSmall)
{
    const WitnessedFloor floor(greyPaint, 0.6f);
    const CrossValidation found = floor.under(floor.irradiance(2.0f));
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
    std::vector<glm::vec3> light = floor.irradiance();
    for (size_t s = 0; s < light.size(); ++s)
        if (floor.surfaces.texels.surfels.position[s].x < 2.5f)
            light[s] *= std::exp2(10.0f * hashedShift(static_cast<uint>(s), 3));
    const CrossValidation found = crossValidate(floor.witnesses, light, {});
    EXPECT_LT(found.albedo, 0.1f * found.scan);
    EXPECT_FALSE(found.improves);
    EXPECT_THAT(warningsOf(found), Contains(HasSubstr("no better than the scan")));
}

// What a person says is not doubted.
TEST(CrossValidation, LightThatIsGivenWrongStandsAndThePersonIsTold)
{
    const LitRoom room;
    const Decomposition result = litWrongly(room.scan);
    EXPECT_EQ(result.crossValidation().shadingPower, 1.0f);
    EXPECT_FALSE(result.crossValidation().improves);
    EXPECT_THAT(result.warnings(), Contains(HasSubstr("--lights")));
    const PageLayers layers = result.layers(0);
    for (const uint8_t confidence : layers.confidence) ASSERT_LE(confidence, 102); // 0.4
    EXPECT_GT(layers.area[static_cast<size_t>(Doubt::unproven)], 1.0);
}

// A texture that light was taken out of before: what looks like a lamp in it lit nothing. Shading
// times albedo is the texture all the same.
TEST(CrossValidation, AScanWithoutLightIsItsOwnAlbedo)
{
    LitRoom room;
    Image& image = room.scan.pages[0].image;
    for (uint16_t& value : image.half())
        if (floatFromHalf(value) < 0.95f) value = halfFromFloat(0.35f);
    const Radiance radiance(image);
    const Decomposition result = delight(scenes::copyOf(room.scan));
    ASSERT_EQ(result.crossValidation().shadingPower, 0.0f);
    EXPECT_TRUE(result.lights().camera.isNeutral());
    EXPECT_THAT(result.warnings(), Contains(HasSubstr("the scan itself")));
    const PageLayers layers = result.layers(0);
    Progress progress;
    const Texels texels = rasterizeAtlas(room.scan, progress);
    const auto at = [](const std::vector<uint16_t>& layer, uint32_t pixel) {
        return floatFromHalf(layer[3 * size_t{pixel} + 1]);
    };
    size_t compared = 0;
    for (const uint32_t pixel : texels.pages[0].pixel) {
        const glm::vec3 shown = radiance[pixel];
        if (std::max({shown.r, shown.g, shown.b}) > 0.9f) continue;
        ASSERT_NEAR(at(layers.albedo, pixel), shown.g, 0.01f * shown.g);
        ASSERT_NEAR(at(layers.direct, pixel) + at(layers.indirect, pixel), 1.0f, 0.01f);
        ++compared;
    }
    EXPECT_GT(compared, 10'000u);
}

} // namespace relamp
