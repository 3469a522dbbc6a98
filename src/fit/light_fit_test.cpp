#include "fit/light_fit_test.h"
#include "base/radiometry.shared.h"
#include "fit/light_fit.h"
#include "lights/candidates.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using testing::ElementsAre;

/// In logarithms, which for a few per cent are shares.
void expectNear(double log, double wanted, double share)
{
    EXPECT_NEAR(log, wanted, std::log1p(share));
}

const glm::vec3 kWall(0.0f);

} // namespace

TEST(LightFit, CleanDataGiveTheLightBackInEveryChannel)
{
    const Floor floor({{40, 30, 20}, {10, 12, 15}}, 0.0f, 0.0f);
    for (int c = 0; c < 3; ++c) {
        const LightEstimate light = floor.solve(c);
        for (size_t f = 0; f < 2; ++f)
            expectNear(light.log[f], std::log(static_cast<double>(floor.truth[f][c])), 0.02);
        expectNear(light.log[2], std::log(static_cast<double>(floor.outside[c])), 0.05);
        EXPECT_LT(light.residual, 0.01);
    }
}

TEST(LightFit, LuminanceOfALampIsThatOfItsColours)
{
    const Floor floor({{40, 30, 20}}, 0.0f, 0.0f);
    expectNear(floor.solve().log[0], floor.truthOf(0), 0.02);
}

// A quarter of the pairs across materials, two per cent of noise: the robust loss lets them go.
TEST(LightFit, NoiseAndWrongPairsHardlyMatter)
{
    const Floor floor({{40, 30, 20}, {10, 12, 15}, {20, 20, 20}}, 0.02f, 0.33f);
    const LightEstimate light = floor.solve();
    for (size_t f = 0; f < 3; ++f) {
        expectNear(light.log[f], floor.truthOf(f), 0.06);
        EXPECT_LT(light.error[f], 0.2);
    }
}

// Pairs of the same places tell the same again: a lamp is known no better for there being more of
// them.
TEST(LightFit, ErrorsDoNotFallWithTheNumberOfPairs)
{
    Floor floor({{40, 30, 20}, {10, 12, 15}}, 0.02f, 0.0f);
    const LightEstimate once = floor.solve();
    const std::vector<MaterialPair> pairs = floor.pairs;
    for (int i = 0; i < 3; ++i) floor.pairs.insert(floor.pairs.end(), pairs.begin(), pairs.end());
    const LightEstimate again = floor.solve();
    for (size_t f = 0; f < 2; ++f) EXPECT_NEAR(again.error[f] / once.error[f], 1.0, 0.05);
    EXPECT_NEAR(again.nats, once.nats, 0.05);
}

// Gathered light is in the texture's units, and so are lamps: half of it is half of everything.
TEST(LightFit, IsInTheUnitsOfTheGatheredLight)
{
    Floor floor({{40, 30, 20}}, 0.0f, 0.0f);
    for (glm::vec3& irradiance : floor.model.gathered) irradiance *= 0.5f;
    expectNear(floor.solve().log[0], floor.truthOf(0) + std::log(0.5), 0.03);
}

// A photo of half the exposure shows, and gathers, half of everything.
TEST(LightFit, FollowsTheExposureOfThePhoto)
{
    Floor floor({{40, 30, 20}, {10, 12, 15}}, 0.0f, 0.0f);
    for (glm::vec3& irradiance : floor.model.gathered) irradiance *= 0.5f;
    for (glm::vec3& shown : floor.model.shown) shown *= 0.5f;
    const LightEstimate light = floor.solve();
    for (size_t f = 0; f < 2; ++f) expectNear(light.log[f], floor.truthOf(f) + std::log(0.5), 0.02);
}

TEST(LightFit, DoesNotDependOnWhereItBegins)
{
    const Floor floor({{40, 30, 20}, {10, 12, 15}}, 0.02f, 0.0f);
    const LightEstimate light = floor.solve();
    const LightEstimate other = floor.solveFromLamps();
    for (size_t f = 0; f < 3; ++f) EXPECT_NEAR(other.log[f], light.log[f], 0.1 * light.error[f]);
    EXPECT_NEAR(other.nats, light.nats, 0.01);
}

TEST(LightFit, WhatTheDataLeaveOpenIsAboutWhiteAndSaysSo)
{
    Floor floor({{40, 30, 20}, {10, 12, 15}}, 0.02f, 0.0f);
    floor.darken(1);
    for (const LightEstimate& light : {floor.solve(), floor.solveFromLamps()}) {
        EXPECT_NEAR(light.log[1], 0.0, 0.5);
        EXPECT_GT(light.error[1], 1.0);
        EXPECT_LT(light.error[0], 0.1);
        expectNear(light.log[0], floor.truthOf(0), 0.05);
    }
}

// 30 times white is burnt out in all channels, save for what the texture mixes; data outweigh that.
TEST(LightFit, MuchMoreThanWhiteIsUnlikelyOfWhatShowsAColour)
{
    Floor floor({{40, 30, 20}}, 0.02f, 0.0f);
    const LightEstimate white = floor.solve();
    floor.model.coloured = {1.0f};
    const LightEstimate coloured = floor.solve();
    EXPECT_GT(coloured.nats, white.nats + 2.0);
    EXPECT_NEAR(coloured.log[0], white.log[0], 0.1);
}

// What scanners miss lies behind things and under them.
TEST(LightFit, OutsideIsDarkerThanTheRoomWhereTheDataLeaveItOpen)
{
    Floor floor({{40, 30, 20}}, 0.0f, 0.0f);
    for (auto& missed : floor.model.missed) missed.clear();
    const LightEstimate light = floor.solveFromLamps();
    std::vector<float> shown;
    for (size_t i = 0; i < floor.model.places(); ++i)
        shown.push_back(luminance(floor.model.shown[i]));
    std::sort(shown.begin(), shown.end());
    const double median = std::log(static_cast<double>(shown[shown.size() / 2]));
    EXPECT_LT(light.log[1], median - 0.5);
    EXPECT_GT(light.log[1], median - 2.0);
    EXPECT_GT(light.error[1], 1.0);
}

// Few places see the lamp, and blue is all noise.
TEST(LightFit, ChannelThatTheDataLeaveOpenIsNearTheLuminance)
{
    Floor floor({{400, 300, 200}}, 0.0f, 0.0f);
    Numbers random;
    for (size_t i = 0; i < Floor::kPlaces; ++i) {
        const glm::vec3 light = floor.truth[0] * floor.model.directAt(i, 0);
        if (i % 80 > 1) {
            const glm::vec3 rest = floor.restAt(i);
            floor.model.shown[i] *= rest / (rest + light);
            floor.model.direct[i].clear();
        }
        floor.model.shown[i].b *= std::exp(3.0f * random.normal());
    }
    const double white = floor.solve().log[0];
    const EmissionPrior prior{{white}, 0.5};
    const auto solveIn = [&](int channel) {
        return floor.fit(channel).solve(floor.emits(), {white, -1.0}, 2.0, prior);
    };
    const LightEstimate blue = solveIn(2);
    EXPECT_NEAR(blue.log[0], white, 1.0); // two of the prior's errors
    for (int c = 0; c < 2; ++c) {
        const LightEstimate light = solveIn(c);
        expectNear(light.log[0], std::log(static_cast<double>(floor.truth[0][c])), 0.1);
        EXPECT_GT(blue.error[0], 2.0 * light.error[0]);
    }
}

// Each of two dozen spots brings little, and a pull to white that grew with their distance from it
// would cost more than they explain.
TEST(LightFit, ManySmallLampsAreNotHeldAtWhite)
{
    constexpr float kSmaller = 100.0f;
    Floor floor(std::vector<glm::vec3>(24, {4.0f, 3.5f, 3.0f}), 0.02f, 0.0f);
    for (std::vector<DirectLight>& ofPlace : floor.model.direct)
        for (DirectLight& direct : ofPlace) direct.irradiance /= kSmaller;
    const LightEstimate light = floor.solve();
    for (size_t f = 0; f < 24; ++f)
        expectNear(light.log[f], floor.truthOf(f) + std::log(kSmaller), 0.2);
}

// Where next to nothing is gathered, twice the lamp is twice the light everywhere, and pairs agree
// as well; but then the room would be half as white.
TEST(LightFit, LevelOfARoomIsHeldWhereLampsOutshineWhatIsGathered)
{
    constexpr float kLamp = 30.0f;
    constexpr float kAlbedo = 0.35f; // of most rooms
    Numbers random;
    LightModel model{.pieces = 1};
    std::vector<MaterialPair> pairs;
    for (uint32_t i = 0; i < 800; ++i) {
        model.gathered.emplace_back(1e-4f);
        model.missed.emplace_back();
        const float direct = random.between(0.05f, 0.2f);
        model.direct.push_back({{0, direct}});
        model.shown.emplace_back(kAlbedo / kPi * kLamp * direct);
        for (const uint32_t step : {1u, 5u, 9u}) pairs.push_back({i, (i + step) % 800});
    }
    addPieces(model);
    const LightFit fit(model, pairs, {}, kPairNoise);
    const LightEstimate light = fit.solve(std::vector<uint8_t>{1}, fit.beginning(), kWide);
    expectNear(light.log[0], std::log(kLamp), 0.1);
    EXPECT_GT(light.error[0], 0.2); // rooms differ
    EXPECT_LT(light.error[0], 0.6);
}

// The paper that burns out first has an albedo of 3/4; and what shows white sends that at least.
TEST(LightFit, WallSendsWhatItReflectsAndNoLessThanItShows)
{
    Floor floor({{40, 30, 20}, kWall}, 0.0f, 0.0f);
    floor.burnOut(1, 0, 0.2f);
    const double irradiance = 0.2 + 0.2 * static_cast<double>(luminance(floor.truth[0]));
    const std::vector<double> log{floor.truthOf(0), 0.0, -1.0};
    expectNear(floor.fit().reflected(log)[1], std::log(0.75 * irradiance / kPi), 0.01);
    floor.burnOut(1, 0, 0.001f);
    EXPECT_NEAR(floor.fit().reflected(log)[1], 0.0, 1e-6);
    floor.burnOut(1, 0, 0.2f); // lights nothing, so that its paint does not matter
    const LightEstimate light = floor.solve();
    EXPECT_NEAR(light.log[1], floor.fit().reflected(light.log)[1], 1e-6);
    EXPECT_EQ(light.error[1], 0.0);
}

// A wall does not emit, but its light reaches the floor: how white it is, the floor tells.
TEST(LightFit, PaintOfAWallThatLightsTheRoomIsFound)
{
    for (const float albedo : {0.5f, 0.9f}) {
        Floor floor({{40, 30, 20}, {10, 10, 10}}, 0.02f, 0.0f);
        floor.burnOut(1, 0, 1.5f);
        const size_t place = floor.model.placeOf(1);
        const glm::vec3 sent = albedo / kPi * (floor.model.gathered[place] + 1.5f * floor.truth[0]);
        for (size_t i = 0; i < Floor::kPlaces; ++i) {
            const float direct[] = {floor.model.directAt(i, 0), floor.model.directAt(i, 1)};
            const glm::vec3 rest = floor.restAt(i) + floor.truth[0] * direct[0];
            floor.model.shown[i] *= (rest + sent * direct[1]) / (rest + floor.truth[1] * direct[1]);
        }
        floor.truth[1] = kWall;
        const LightEstimate light = floor.solve();
        expectNear(light.log[0], floor.truthOf(0), 0.05);
        expectNear(light.log[1], std::log(static_cast<double>(luminance(sent))), 0.1);
    }
}

// White paper is no whiter than 0.9: what shows white gets pi / 0.9 at least.
TEST(LightFit, BurntOutWallBoundsALampFromBelow)
{
    Floor floor({{40, 30, 20}, {40, 30, 20}, kWall}, 0.02f, 0.0f);
    floor.darken(1); // places see nothing of it
    const LightEstimate without = floor.solve();
    floor.burnOut(2, 1, 0.1f);
    const double least = (static_cast<double>(kPi) / 0.9 - 0.2) / 0.1;
    std::vector<double> start = without.log;
    start[1] = std::log(0.5 * least);
    const LightEstimate light = floor.fit().solve(floor.emits(), start, 1.0);
    expectNear(light.log[1], std::log(least), 0.2);
    EXPECT_NEAR(light.log[0], without.log[0], 0.2 * without.error[0]);
}

TEST(LightFit, BurntOutWallThatGetsEnoughSaysNothing)
{
    Floor floor({{40, 30, 20}, {10, 12, 15}, kWall}, 0.02f, 0.0f);
    const LightEstimate without = floor.solve();
    floor.burnOut(2, 1, 1.0f);
    const LightEstimate with = floor.solve();
    for (size_t f = 0; f < 2; ++f) EXPECT_NEAR(with.log[f], without.log[f], 0.002);
}

// Polish shows the lamp itself, and needs no light for it: a few such pieces, one of a flaw of the
// texture among them, do not outweigh what a whole floor says of the lamp.
TEST(LightFit, HighlightsDoNotMakeLampsBrighter)
{
    for (const float direct : {0.01f, 0.1f, 0.2f}) { // all too little
        Floor floor({{40, 30, 20}, {10, 12, 15}, kWall, kWall, kWall, kWall}, 0.02f, 0.0f);
        const LightEstimate without = floor.solve();
        for (const size_t wall : {2u, 3u, 4u, 5u}) floor.burnOut(wall, 1, direct, kSpeck);
        const LightEstimate with = floor.solve();
        EXPECT_LT(with.nats - without.nats, 5.0); // four times the odds of a flaw
        for (size_t f = 0; f < 2; ++f)
            EXPECT_NEAR(with.log[f], without.log[f], 0.5 * without.error[f]);
    }
}

// A pane that gets an eighth of the light which white paper would need shines; so small a highlight
// need not, nor a wall that fades as overexposed ones do.
TEST(LightFit, ALargePieceThatEndsSharplyIsNoHighlight)
{
    const auto lackOf = [](float area, bool isFading) {
        Floor floor({{40, 30, 20}, {10, 12, 15}, kWall}, 0.02f, 0.0f);
        const double without = floor.solve().nats;
        floor.burnOut(2, 1, 0.02f, area);
        floor.model.fades = {0, 0, static_cast<uint8_t>(isFading ? 1 : 0)};
        return floor.solve().nats - without;
    };
    const double ofSpeck = lackOf(kSpeck, false);
    EXPECT_LT(ofSpeck, 1.3);
    EXPECT_GT(lackOf(1.0f, false), 2.0 * ofSpeck);
    EXPECT_NEAR(lackOf(0.5f * kSpeck, false), ofSpeck, 1e-6);
    EXPECT_NEAR(lackOf(1.0f, true), ofSpeck, 1e-6);
}

// A wall of warm light burns out in red first, and would make lamps redder than they are.
TEST(LightFit, BurntOutWallsSayNothingOfTheColourOfALampThatPlacesSee)
{
    Floor floor({{40, 30, 20}, {10, 12, 15}, kWall, kWall}, 0.02f, 0.0f);
    const auto colourOf = [&] {
        std::vector<double> log = floor.solve().log;
        const EmissionPrior prior{log, 0.5};
        const auto channel = [&](int c) {
            return floor.fit(c).solve(floor.emits(), log, 2.0, prior).log[1];
        };
        return channel(0) - channel(2);
    };
    const double without = colourOf();
    for (const size_t wall : {2u, 3u}) {
        floor.burnOut(wall, 1, 0.3f);
        floor.model.shown[floor.model.placeOf(wall)] = {1.0f, 0.7f, 0.4f};
    }
    expectNear(colourOf(), without, 0.02);
}

// Of two lamps of one model, one lights nothing that is seen: it is about as bright as the other.
TEST(LightFit, LampsOfOneModelAreAboutEquallyBright)
{
    Floor floor({{40, 30, 20}, {40, 30, 20}}, 0.02f, 0.0f);
    floor.darken(1);
    floor.alike = {{0, 1}};
    const LightEstimate light = floor.solve();
    expectNear(light.log[1], light.log[0], 0.1);
    EXPECT_GT(light.error[1], 5.0 * light.error[0]); // they may be dimmed
    EXPECT_LT(light.error[1], 1.0);
}

// Lamps of one model that are seen well speak for themselves.
TEST(LightFit, DimmedLampOfOneModelIsFoundDim)
{
    Floor floor({{40, 30, 20}, {4, 3, 2}}, 0.0f, 0.0f);
    floor.alike = {{0, 1}};
    const LightEstimate light = floor.solve();
    for (size_t f = 0; f < 2; ++f) EXPECT_NEAR(light.log[f], floor.truthOf(f), light.error[f]);
}

TEST(LightFit, WithoutPairsNothingIsKnown)
{
    Floor floor({glm::vec3(20.0f)}, 0.0f, 0.0f);
    floor.pairs.clear();
    const LightEstimate light = floor.solve();
    EXPECT_GT(light.error[0], 0.3);
    EXPECT_TRUE(std::isfinite(light.error[0]));
    EXPECT_TRUE(std::isfinite(light.log[0]));
    EXPECT_TRUE(std::isfinite(light.nats));
    EXPECT_EQ(light.residual, 0.0);
}

namespace
{

/// A floor of one paint under a lamp of radiance 40; a third of it lies in the dark.
struct DarkCorners
{
    static constexpr size_t kPlaces = 600;

    LightModel model{.pieces = 1};
    std::vector<MaterialPair> pairs;

    /// `stray`: irradiance that the model has too much of, in the dark.
    explicit DarkCorners(float stray)
    {
        Numbers random;
        for (size_t i = 0; i < kPlaces; ++i) {
            const bool isDark = i % 3 == 0;
            const float gathered = isDark ? random.between(0.1f, 0.2f) : random.between(0.4f, 0.6f);
            const float direct = isDark ? 0.0f : random.between(0.005f, 0.05f);
            model.shown.emplace_back(0.35f / kPi * (gathered + 40.0f * direct));
            model.gathered.emplace_back(gathered + (isDark ? stray : 0.0f));
            model.missed.emplace_back();
            model.direct.push_back({{0, direct}});
        }
        for (size_t i = 0; i < 8 * kPlaces; ++i)
            pairs.push_back({static_cast<uint32_t>(random.between(0, kPlaces - 1)),
                             static_cast<uint32_t>(random.between(0, kPlaces - 1))});
        addPieces(model);
    }

    /// How far off the lamp is, in logarithms, where leaks are expected and where not.
    [[nodiscard]] double offWith(bool leaks) const
    {
        const std::vector<uint8_t> emits{1};
        LightFit fit(model, pairs, {}, kPairNoise);
        LightEstimate light = fit.solve(emits, fit.beginning(), kWide);
        if (leaks) {
            fit.expectLeaks(light.log);
            light = fit.solve(emits, light.log, 1.0);
        }
        return light.log[0] - std::log(40.0);
    }

    /// In the light that is there.
    [[nodiscard]] double gaps() const
    {
        return LightFit(model, pairs, {}, kPairNoise)
            .gaps(std::vector<double>{std::log(40.0), 0.0});
    }
};

} // namespace

// Through the gaps of a reconstruction light gets into corners that were dark in the room, and what
// is lit would have to be as much brighter.
TEST(LightFit, LeaksIntoTheDarkMakeLampsLessStrongWhereTheyAreExpected)
{
    for (const float stray : {0.01f, 0.02f, 0.03f}) { // up to 3 % of the median light
        const DarkCorners corners(stray);
        EXPECT_GT(corners.offWith(false), 0.05);
        EXPECT_LT(corners.offWith(true), 0.8 * corners.offWith(false));
        EXPECT_GT(corners.offWith(true), -0.02);
    }
}

// Where dark places ask for weaker lamps, it is no light through gaps, and they are heard as
// before.
TEST(LightFit, DarkPlacesThatMakeLampsWeakerAreHeard)
{
    const DarkCorners corners(-0.05f);
    EXPECT_LT(corners.offWith(false), -0.1);
    EXPECT_LT(corners.offWith(true), 0.9 * corners.offWith(false));
}

TEST(LightFit, ExpectingLeaksChangesNothingWhereAllIsRight)
{
    EXPECT_NEAR(DarkCorners(0.0f).offWith(true), 0.0, 0.02);
}

// Not so where they are too bright, nor where they differ both ways.
TEST(LightFit, DarkPlacesThatAreTooDarkInTheMeanTellOfGaps)
{
    EXPECT_GT(DarkCorners(0.05f).gaps(), 0.9);
    EXPECT_LT(DarkCorners(0.0f).gaps(), 0.1);
    EXPECT_LT(DarkCorners(-0.05f).gaps(), 0.1);
    DarkCorners uneven(0.0f);
    Numbers random;
    for (size_t i = 0; i < DarkCorners::kPlaces; i += 3)
        uneven.model.shown[i] *= std::exp(random.between(-0.2f, 0.2f));
    EXPECT_LT(uneven.gaps(), 0.3);
}

// Of what was seen; a sun is brighter than that.
TEST(LightFit, BrighterThanABareBulbIsLessLikely)
{
    const auto natsAt = [](float brightness, float area) {
        Floor floor({brightness * glm::vec3(40, 30, 20)}, 0.02f, 0.0f);
        for (size_t i = 0; i < floor.model.places(); ++i)
            for (DirectLight& light : floor.model.direct[i]) light.irradiance /= brightness;
        floor.model.area[0] = area;
        return floor.fit().solve(floor.emits(), {std::log(30.0 * brightness), 0.0}, 1.0).nats;
    };
    EXPECT_NEAR(natsAt(1.0f, 0.1f), natsAt(1.0f, 0.0f), 1e-6);
    EXPECT_GT(natsAt(1000.0f, 0.1f), natsAt(1000.0f, 0.0f) + 3.0);
}

} // namespace relamp
