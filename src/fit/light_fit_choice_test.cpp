#include "base/radiometry.shared.h"
#include "fit/light_fit.h"
#include "fit/light_fit_test.h"
#include "fit/light_gain.h"

#include <cmath>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using testing::ElementsAre;

constexpr double kLampCosts = 1.5; // nats

/// A grey floor: lamp 0 lights its first half, lamp 1 does just the same, lamp 2 nothing.
struct HalfLitFloor
{
    LightModel model{.pieces = 3};
    std::vector<MaterialPair> pairs;
    std::vector<AlikePieces> alike;

    HalfLitFloor()
    {
        for (int i = 0; i < 64; ++i) {
            const float lit = i < 32 ? 0.1f + 0.01f * static_cast<float>(i) : 0.0f;
            model.direct.push_back({{0, lit}, {1, lit}});
            model.gathered.emplace_back(0.2f);
            model.missed.emplace_back();
            model.shown.emplace_back(0.35f / kPi * (0.2f + 10.0f * lit));
        }
        for (uint32_t p = 0; p < 32; ++p) pairs.push_back({p, p + 32});
        addPieces(model);
    }

    [[nodiscard]] std::vector<uint8_t> needless(const std::vector<Removal>& removals) const
    {
        const std::vector<uint8_t> emits{1, 1, 1};
        const LightFit fit(model, pairs, alike, kPairNoise);
        return fit.needless(fit.solve(emits, fit.beginning(), kWide), emits, removals);
    }
};

} // namespace

// Two lamps that do the same stand in for each other: one goes, and then the other is needed.
TEST(LightFit, OneOfTwoEqualLampsIsNeedlessAndBothAreNot)
{
    const HalfLitFloor floor;
    const std::vector<uint8_t> gone = floor.needless({{{0}, kLampCosts}, {{1}, kLampCosts}});
    EXPECT_EQ(gone[0] + gone[1], 1);
    EXPECT_THAT(floor.needless({{{0, 1}, 2.0 * kLampCosts}}), ElementsAre(0));
}

TEST(LightFit, OneOfTwoEqualLampsOfOneModelIsNeedless)
{
    HalfLitFloor floor;
    floor.alike = {{0, 1}};
    const std::vector<uint8_t> gone = floor.needless({{{0}, kLampCosts}, {{1}, kLampCosts}});
    EXPECT_EQ(gone[0] + gone[1], 1);
}

TEST(LightFit, LampThatLightsNothingIsNeedlessAndGoesFirst)
{
    const HalfLitFloor floor;
    EXPECT_THAT(floor.needless({{{2}, kLampCosts}, {{0, 1}, kLampCosts}}), ElementsAre(1, 0));
}

// The quadratic form says what fits without each say.
TEST(LightFit, WhatIsNeededIsWhatCostsMoreToDoWithout)
{
    Floor floor({{40, 30, 20}, {10, 12, 15}, {0.2f, 0.2f, 0.2f}}, 0.02f, 0.0f);
    const LightFit fit = floor.fit();
    const LightEstimate all = floor.solve();
    const std::vector<uint8_t> gone =
        fit.needless(all, floor.emits(),
                     std::vector<Removal>{{{0}, kLampCosts}, {{1}, kLampCosts}, {{2}, kLampCosts}});
    for (size_t f = 0; f < 3; ++f) {
        std::vector<uint8_t> emits = floor.emits();
        emits[f] = 0;
        const double lost = fit.solve(emits, all.log, 1.0).nats - all.nats;
        EXPECT_EQ(gone[f] != 0, lost < kLampCosts) << f << ": " << lost << " nats";
    }
    EXPECT_THAT(gone, ElementsAre(0, 0, 1));
}

namespace
{

constexpr double kMissing = 20.0; // radiance of the lamp that the fit does without

/// A grey floor whose left half lies under a lamp of a fit, and its middle under one more.
struct LitFloor
{
    enum Lamp { left, middle, right, nowhere };

    LightModel model{.pieces = 4};
    std::vector<MaterialPair> pairs;

    LitFloor()
    {
        for (uint32_t i = 0; i < 90; ++i) {
            const float falloff = 0.02f + 0.001f * static_cast<float>(i % 15);
            const float ofLeft = i < 45 ? falloff : 0.0f;
            const float ofMiddle = i >= 30 && i < 60 ? falloff : 0.0f;
            model.direct.push_back(
                {{left, ofLeft}, {middle, ofMiddle}, {right, i >= 60 ? falloff : 0.0f}});
            model.gathered.emplace_back(0.2f);
            model.missed.emplace_back();
            model.shown.emplace_back(
                0.5f * (0.2f + 5.0f * ofLeft + static_cast<float>(kMissing) * ofMiddle) / kPi);
            pairs.push_back({i, (i * 37 + 11) % 90});
        }
        addPieces(model);
    }

    static constexpr double dark = -9.0;

    /// `ofMiddle`: radiance that the fit has there.
    [[nodiscard]] std::vector<double> gains(double ofMiddle, double& log) const
    {
        const LightEstimate estimate{.log = {std::log(5.0), std::log(ofMiddle), dark, dark, dark}};
        const LightFit fit(model, pairs, {}, kPairNoise);
        std::vector<double> gains;
        for (const size_t lamp : {left, middle, right, nowhere}) {
            double at = 0.0;
            gains.push_back(LightGain(fit, estimate).of(lamp, at));
            if (lamp == middle) log = at;
        }
        return gains;
    }
};

} // namespace

// The light of one lamp is missing from the model, and only where that lamp shines.
TEST(LightFit, LampThatIsMissingGainsMuchAndItsLightIsKnownRoughly)
{
    double log = 0.0;
    const std::vector<double> gains = LitFloor().gains(1e-4, log);
    EXPECT_GT(gains[LitFloor::middle], 10.0 * kLampCosts);
    EXPECT_NEAR(log, std::log(kMissing), std::log(3.0));
    EXPECT_EQ(gains[LitFloor::right], 0.0);
    EXPECT_LT(gains[LitFloor::left], 0.1 * gains[LitFloor::middle]);
}

TEST(LightFit, NothingIsGainedWhereAllLightIsKnownNorByWhatLightsNothing)
{
    double log = 0.0;
    for (const double gain : LitFloor().gains(kMissing, log)) EXPECT_LT(gain, 0.01);
}

// All else stays as it is, so that a fit gains more.
TEST(LightFit, GainIsNoMoreThanAFitGains)
{
    const Floor floor({{40, 30, 20}, {10, 12, 15}}, 0.02f, 0.0f);
    const LightFit fit = floor.fit();
    const LightEstimate without = fit.solve(std::vector<uint8_t>{1, 0}, fit.beginning(), kWide);
    double log = 0.0;
    const double gain = LightGain(fit, without).of(1, log);
    const LightEstimate with = fit.solve(floor.emits(), {without.log[0], log, without.log[2]}, 1.0);
    EXPECT_GT(gain, kLampCosts);
    EXPECT_LT(gain, without.nats - with.nats + 1.0); // priors
    EXPECT_NEAR(with.log[1], floor.truthOf(1), 2.0 * with.error[1]);
}

// A wall cannot be brighter than the light on it makes it; a lamp can.
TEST(LightFit, BurntOutPieceInTheDarkGainsByEmitting)
{
    Floor floor({{40, 30, 20}, {1, 1, 1}}, 0.02f, 0.0f);
    const std::vector<uint8_t> emits{1, 0};
    double log = 0.0;
    const auto gain = [&](float direct) {
        floor.burnOut(1, 0, direct);
        const LightFit fit = floor.fit();
        return LightGain(fit, fit.solve(emits, fit.beginning(), kWide)).of(1, log);
    };
    const double lit = gain(1.0f);
    EXPECT_GT(gain(0.01f), lit + 0.5);
}

// Its light makes the pairs worse as long as all others stay as they are, so only a fit can tell.
TEST(LightFit, BurntOutPieceThatLacksLightGainsThoughItsLightAloneDoesNot)
{
    LitFloor floor;
    floor.model.area[LitFloor::right] = 1.0f;
    const LightFit fit(floor.model, floor.pairs, {}, kPairNoise);
    const double white = 0.0;
    const LightEstimate estimate{
        .log = {std::log(5.0), std::log(kMissing), white, LitFloor::dark, LitFloor::dark}};
    const LightGain gain(fit, estimate);
    double log = 0.0;
    EXPECT_GT(gain.of(LitFloor::right, log), 1.0);
    EXPECT_EQ(log, 0.0);
    EXPECT_GT(gain.leastOf(LitFloor::right), white);
    EXPECT_LT(gain.leastOf(LitFloor::right), white + std::log(3.0) + 1e-6);
}

} // namespace relamp
