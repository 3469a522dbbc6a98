#include "base/radiometry.shared.h"
#include "fit/powers.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr size_t kPowerPlaces = 800;

/// Numbers that are the same on every machine; distributions of the standard need not be.
class Numbers
{
public:
    float between(float low, float high)
    {
        return low + (high - low) * static_cast<float>(random_() >> 8) / 16777216.0f;
    }
    /// Of mean 0 and variance 1, about.
    float normal()
    {
        float sum = -6.0f;
        for (int i = 0; i < 12; ++i) sum += between(0.0f, 1.0f);
        return sum;
    }

private:
    std::mt19937 random_{7};
};

/// A floor of two materials under lamps, with what every lamp does there known.
struct Floor
{
    FitData data;
    std::vector<MaterialPair> pairs;
    std::vector<glm::vec3> truth; // of lamps
    glm::vec3 ambient{0.5f, 0.4f, 0.3f};

    /// `noise` of radiance, as a share; `outliers` share of the pairs across materials.
    Floor(std::vector<glm::vec3> lamps, float noise, float outliers);
};

Floor::Floor(std::vector<glm::vec3> lamps, float noise, float outliers) : truth(std::move(lamps))
{
    Numbers random;
    data.lamps = truth.size();
    std::vector<glm::vec2> under;
    for (size_t f = 0; f < data.lamps; ++f)
        under.emplace_back(random.between(1, 4), random.between(1, 4));
    for (size_t i = 0; i < kPowerPlaces; ++i) {
        const glm::vec2 place(random.between(0, 5), random.between(0, 5));
        glm::vec3 irradiance(random.between(0.2f, 0.5f));
        data.gathered.push_back(irradiance);
        data.missed.push_back(place.x < 2.0f ? random.between(0.0f, 0.4f) : 0.0f);
        irradiance += ambient * data.missed.back();
        for (size_t f = 0; f < data.lamps; ++f) {
            const float squared = 4.0f + glm::dot(place - under[f], place - under[f]);
            const bool isShadow = random.between(0, 1) < 0.3f;
            data.direct.push_back(isShadow ? 0.0f : 0.1f * 4.0f / (squared * squared));
            irradiance += truth[f] * data.direct.back();
        }
        const float albedo = (i % 2 == 0 ? 0.7f : 0.3f) * std::exp(noise * random.normal());
        data.radiance.push_back(albedo * irradiance / kPi);
    }
    for (size_t i = 0; i < 8 * kPowerPlaces; ++i) {
        const auto p = static_cast<uint32_t>(random.between(0, kPowerPlaces - 1));
        const auto q = static_cast<uint32_t>(random.between(0, kPowerPlaces - 1));
        const bool sameMaterial = p % 2 == q % 2;
        if (p != q && (sameMaterial || random.between(0, 1) < outliers)) pairs.push_back({p, q});
    }
}

void expectNear(glm::vec3 value, glm::vec3 wanted, float share)
{
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(value[c], wanted[c], share * wanted[c]) << "channel " << c;
}

} // namespace

TEST(Powers, CleanDataGiveThePowersBack)
{
    const Floor floor({{40, 30, 20}, {10, 12, 15}}, 0.0f, 0.0f);
    const Powers powers = fitPowers(floor.data, floor.pairs);
    expectNear(powers.radiance[0], floor.truth[0], 0.02f);
    expectNear(powers.radiance[1], floor.truth[1], 0.02f);
    expectNear(powers.ambient, floor.ambient, 0.05f);
    EXPECT_LT(powers.residual, 0.01f);
}

// A quarter of the pairs across materials, two per cent of noise: the robust loss lets them go.
TEST(Powers, NoiseAndWrongPairsHardlyMatter)
{
    const Floor floor({{40, 30, 20}, {10, 12, 15}, {20, 20, 20}}, 0.02f, 0.33f);
    const Powers powers = fitPowers(floor.data, floor.pairs);
    for (size_t f = 0; f < 3; ++f) {
        expectNear(powers.radiance[f], floor.truth[f], 0.06f);
        EXPECT_LT(powers.logError[f].g, 0.2f);
    }
}

// Pairs of the same places tell the same again: a lamp is known no better for there being more of
// them.
TEST(Powers, ErrorsDoNotFallWithTheNumberOfPairs)
{
    const Floor floor({{40, 30, 20}, {10, 12, 15}}, 0.02f, 0.0f);
    std::vector<MaterialPair> fourfold;
    for (int i = 0; i < 4; ++i)
        fourfold.insert(fourfold.end(), floor.pairs.begin(), floor.pairs.end());
    const Powers once = fitPowers(floor.data, floor.pairs);
    const Powers again = fitPowers(floor.data, fourfold);
    for (size_t f = 0; f < 2; ++f)
        EXPECT_NEAR(again.logError[f].g / once.logError[f].g, 1.0f, 0.05f);
}

// Gathered light is in the texture's units, and so powers are: half of it is half of everything.
TEST(Powers, AreInTheUnitsOfTheGatheredLight)
{
    Floor floor({{40, 30, 20}}, 0.0f, 0.0f);
    for (glm::vec3& irradiance : floor.data.gathered) irradiance *= 0.5f;
    const Powers powers = fitPowers(floor.data, floor.pairs);
    expectNear(powers.radiance[0], 0.5f * floor.truth[0], 0.02f);
}

TEST(Powers, WhatTheDataLeaveOpenIsWhiteAndSaysSo)
{
    Floor floor({{40, 30, 20}, {10, 12, 15}}, 0.02f, 0.0f);
    for (size_t i = 0; i < kPowerPlaces; ++i) floor.data.direct[2 * i + 1] = 0.0f;
    const Powers powers = fitPowers(floor.data, floor.pairs);
    expectNear(powers.radiance[1], glm::vec3(1.0f), 0.05f);
    EXPECT_GT(powers.logError[1].g, 10.0f * powers.logError[0].g);
    EXPECT_LT(powers.told[1], 0.05f);
    EXPECT_GT(powers.told[0], 0.95f);
}

// What scanners miss lies behind things and under them.
TEST(Powers, WhatLiesBehindHolesIsDarkerThanTheRoomWhereTheDataLeaveItOpen)
{
    Floor floor({{40, 30, 20}}, 0.0f, 0.0f);
    for (float& missed : floor.data.missed) missed = 0.0f;
    const glm::vec3 ambient = fitPowers(floor.data, floor.pairs).ambient;
    std::vector<float> greens;
    for (const glm::vec3 radiance : floor.data.radiance) greens.push_back(radiance.g);
    std::sort(greens.begin(), greens.end());
    EXPECT_NEAR(ambient.g, 0.3f * greens[greens.size() / 2], 0.02f * ambient.g);
}

TEST(Powers, AChannelThatTheDataLeaveOpenIsAsBrightAsTheLamp)
{
    Floor floor({{400, 300, 200}}, 0.0f, 0.0f);
    Numbers random;
    for (size_t i = 0; i < kPowerPlaces; ++i) { // few places see the lamp, and blue is all noise
        const glm::vec3 light = floor.truth[0] * floor.data.direct[i];
        if (i % 80 > 1) {
            const glm::vec3 rest = floor.data.gathered[i] + floor.ambient * floor.data.missed[i];
            floor.data.radiance[i] *= rest / (rest + light);
            floor.data.direct[i] = 0.0f;
        }
        floor.data.radiance[i].b *= std::exp(3.0f * random.normal());
    }
    const glm::vec3 lamp = fitPowers(floor.data, floor.pairs).radiance[0];
    expectNear(glm::vec3(lamp.r, lamp.g, 1.0f), glm::vec3(400, 300, 1), 0.05f);
    EXPECT_GT(lamp.b, 100.0f);
    EXPECT_LT(lamp.b, 600.0f);
}

/// Adds places that are burnt out to white, where lamp 1 of two gives `direct` at radiance 1.
void burnOut(FitData& data, size_t places, float direct)
{
    for (size_t i = 0; i < places; ++i) {
        data.radiance.emplace_back(1.0f);
        data.gathered.emplace_back(0.2f);
        data.missed.push_back(0.0f);
        data.direct.insert(data.direct.end(), {0.0f, direct});
        ++data.burntOut;
    }
}

// White paper is no whiter than 0.9: what shows white gets pi / 0.9 at least.
TEST(Powers, BurntOutPlacesBoundALampFromBelow)
{
    Floor floor({{40, 30, 20}, {0, 0, 0}}, 0.02f,
                0.0f); // what is measured gets nothing from lamp 1
    for (size_t i = 0; i < kPowerPlaces; ++i) floor.data.direct[2 * i + 1] = 0.0f;
    const Powers without = fitPowers(floor.data, floor.pairs);
    burnOut(floor.data, 50, 0.1f);
    const Powers powers = fitPowers(floor.data, floor.pairs);
    const float least = (kPi / 0.9f - 0.2f) / 0.1f;
    expectNear(powers.radiance[1], glm::vec3(least), 0.05f);
    expectNear(powers.radiance[0], without.radiance[0], 0.01f);
}

// Each of two dozen spots brings little, and a pull to white that grew with their distance from it
// would cost more than they explain.
TEST(Powers, ManySmallLampsAreNotHeldAtWhite)
{
    constexpr float kSmaller = 100.0f;
    Floor floor(std::vector<glm::vec3>(24, {4.0f, 3.5f, 3.0f}), 0.02f, 0.0f);
    for (float& direct : floor.data.direct) direct /= kSmaller;
    const Powers powers = fitPowers(floor.data, floor.pairs);
    for (size_t f = 0; f < 24; ++f) expectNear(powers.radiance[f], kSmaller * floor.truth[f], 0.2f);
}

// Where next to nothing is gathered, twice the lamp is twice the light everywhere, and pairs agree
// as well; but then the room would be half as white.
TEST(Powers, LevelOfARoomIsHeldWhereLampsOutshineWhatIsGathered)
{
    const glm::vec3 lamp(40, 30, 20);
    constexpr float kAlbedo = 0.35f;
    Numbers random;
    FitData data{.lamps = 1};
    std::vector<MaterialPair> pairs;
    for (uint32_t i = 0; i < kPowerPlaces; ++i) {
        data.gathered.emplace_back(1e-4f);
        data.missed.push_back(0.0f);
        data.direct.push_back(random.between(0.05f, 0.2f));
        data.radiance.push_back(kAlbedo / kPi * lamp * data.direct.back());
        for (const uint32_t step : {1u, 5u, 9u})
            pairs.push_back({i, static_cast<uint32_t>((i + step) % kPowerPlaces)});
    }
    expectNear(fitPowers(data, pairs).radiance[0], lamp, 0.25f);
}

TEST(Powers, BurntOutPlacesSayNothingOfColour)
{
    Floor floor({{40, 30, 20}, {10, 12, 15}}, 0.02f, 0.0f);
    const Powers without = fitPowers(floor.data, floor.pairs);
    burnOut(floor.data, 200, 0.1f);
    for (size_t i = kPowerPlaces; i < floor.data.radiance.size(); ++i)
        floor.data.radiance[i] = {1.0f, 0.7f, 0.4f};
    const Powers with = fitPowers(floor.data, floor.pairs);
    EXPECT_GT(with.radiance[1].g, 1.2f * without.radiance[1].g);
    expectNear(with.radiance[1] / with.radiance[1].g, without.radiance[1] / without.radiance[1].g,
               1e-3f);
}

TEST(Powers, BurntOutPlaceThatGetsEnoughSaysNothing)
{
    Floor floor({{40, 30, 20}, {10, 12, 15}}, 0.02f, 0.0f);
    const Powers without = fitPowers(floor.data, floor.pairs);
    burnOut(floor.data, 50, 1.0f);
    const Powers with = fitPowers(floor.data, floor.pairs);
    expectNear(with.radiance[1], without.radiance[1], 1e-3f);
}

// Polish shows the lamp itself: a tenth of white light makes it white.
TEST(Powers, HighlightsDoNotMakeLampsBrighter)
{
    Floor floor({{40, 30, 20}, {10, 12, 15}}, 0.02f, 0.0f);
    const Powers without = fitPowers(floor.data, floor.pairs);
    burnOut(floor.data, 20, 0.01f);
    const Powers with = fitPowers(floor.data, floor.pairs);
    expectNear(with.radiance[1], without.radiance[1], 0.02f);
}

// Of two lamps of one model, one lights nothing that is seen: it is as bright as the other.
TEST(Powers, LampsOfOneModelAreAboutEquallyBright)
{
    Floor floor({{40, 30, 20}, {40, 30, 20}}, 0.02f, 0.0f);
    for (size_t i = 0; i < kPowerPlaces; ++i) floor.data.direct[2 * i + 1] = 0.0f;
    const Powers powers =
        fitPowers(floor.data, floor.pairs, {.priorWeight = 1e-6, .alike = {{0, 1}}});
    expectNear(powers.radiance[1], powers.radiance[0], 0.1f);
}

TEST(Powers, LampsOfOneModelAreAsBrightAsExpectedOfWhatTheScanShowsOfThem)
{
    Floor floor({{40, 30, 20}, {40, 30, 20}}, 0.02f, 0.0f);
    for (size_t i = 0; i < kPowerPlaces; ++i) floor.data.direct[2 * i + 1] = 0.0f;
    const Powers powers =
        fitPowers(floor.data, floor.pairs, {.priorWeight = 1e-6, .alike = {{1, 0, 3.0f}}});
    expectNear(powers.radiance[1], 3.0f * powers.radiance[0], 0.1f);
}

TEST(Powers, OneChannelIsLuminance)
{
    const Floor floor({glm::vec3(20.0f)}, 0.0f, 0.0f);
    const Powers powers = fitPowers(floor.data, floor.pairs, {.oneChannel = true});
    EXPECT_EQ(powers.radiance[0].r, powers.radiance[0].b);
    EXPECT_NEAR(powers.radiance[0].g, 20.0f, 0.6f);
}

TEST(Powers, WithoutPairsNothingIsKnown)
{
    Floor floor({glm::vec3(20.0f)}, 0.0f, 0.0f);
    const Powers powers = fitPowers(floor.data, {});
    expectNear(powers.radiance[0], glm::vec3(1.0f), 0.01f);
    EXPECT_TRUE(std::isfinite(powers.logError[0].g));
    EXPECT_TRUE(std::isfinite(powers.loss));
}

} // namespace relamp
