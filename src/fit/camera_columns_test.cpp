#include "fit/camera_columns.h"

#include "base/radiometry.shared.h"
#include "fit/light_fit.h"
#include "scan/gain.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

constexpr double kNoiseOfPaint = 0.03; // log

/// A wall of 4 x 3 m that one lamp lights, 0.6 m before its foot: light falls over five octaves.
struct LitWall
{
    LightModel model{.pieces = 1};
    std::vector<glm::vec3> positions;
    std::vector<MaterialPair> pairs;

    /// `paintNoise`: log, of albedo from place to place. `gathered`: irradiance by other walls.
    explicit LitWall(double paintNoise, float gathered = 0.02f)
    {
        constexpr float kRadiance = 60.0f;
        std::mt19937 random(3);
        const auto unit = [&] { return static_cast<float>(random() >> 8) / 16777216.0f; };
        for (int i = 0; i < 2000; ++i) {
            const float x = 4.0f * unit();
            const float y = 3.0f * unit();
            positions.emplace_back(x, y, 0.0f);
            const glm::vec3 way(2.0f - x, -y, 0.6f);
            const float squared = glm::dot(way, way);
            const float direct = 0.02f * 0.6f / (squared * std::sqrt(squared));
            const double noise =
                paintNoise * static_cast<double>(unit() + unit() + unit() - 1.5f) * 2.0;
            model.gathered.emplace_back(gathered);
            model.missed.emplace_back();
            model.direct.push_back({{0, direct}});
            model.shown.emplace_back(0.4f / kPi * (gathered + kRadiance * direct) *
                                     static_cast<float>(std::exp(noise)));
        }
        for (size_t i = 0; i < 3 * positions.size(); ++i)
            pairs.push_back({static_cast<uint32_t>(random() % positions.size()),
                             static_cast<uint32_t>(random() % positions.size())});
        std::erase_if(pairs, [](MaterialPair pair) { return pair.p == pair.q; });
        model.shown.emplace_back(1.0f); // the lamp, of which nothing is seen
        model.gathered.emplace_back(0.0f);
        model.missed.emplace_back();
        model.direct.emplace_back();
        model.area.push_back(0.0f);
    }

    [[nodiscard]] size_t places() const { return positions.size(); }
    [[nodiscard]] TexturePlaces asSeen() const
    {
        return {std::span(model.shown).first(places()), positions};
    }
    [[nodiscard]] LightEstimate solve(const CameraColumns& camera, double widest = 1.0) const
    {
        const std::vector<uint8_t> emits{1};
        const LightFit fit(model, pairs, {}, kNoiseOfPaint);
        return fit.solve(emits, fit.beginning(), camera, widest);
    }
};

} // namespace

// The proof of docs/method/camera.md: one wall under one lamp tells the contrast.
TEST(CameraColumns, OneLampOnOneWallTellsTheContrastToOnePercent)
{
    for (const double contrast : {0.7, 1.0, 1.35}) {
        LitWall wall(0.01);
        for (size_t i = 0; i < wall.places(); ++i) {
            glm::vec3& shown = wall.model.shown[i];
            shown = glm::vec3(0.18f * std::pow(shown.g / 0.18f, static_cast<float>(contrast)));
        }
        CameraColumns columns = columnsOf(Response{}, wall.asSeen());
        columns.worth = 100.0; // the places are independent
        const Response response = responseOf(wall.solve(columns).camera);
        EXPECT_NEAR(response.contrast(), contrast, 0.01 * contrast);
    }
}

TEST(CameraColumns, AWallThatIsStraightStaysStraight)
{
    const LitWall wall(0.03);
    const LightEstimate light = wall.solve(columnsOf(Response{}, wall.asSeen()));
    EXPECT_NEAR(responseOf(light.camera).contrast(), 1.0f, 0.05f);
}

TEST(CameraColumns, AnEvenSlopeIsThatSlopeAtAllBrightnesses)
{
    const LitWall wall(0.03);
    const CameraColumns even = evenSlope(columnsOf(Response{}, wall.asSeen()));
    ASSERT_EQ(even.count(), 1u);
    Response flat;
    flat.slope.fill(0.8f);
    const auto off = [&](size_t i) {
        const float shown = wall.model.shown[i].g;
        return std::log(flat(shown) / shown) - (0.8f - 1.0f) * even.bend[i];
    };
    for (size_t i = 0; i < wall.places(); ++i) {
        EXPECT_NEAR(off(i), off(0), 1e-4f); // the mean over places is taken out of the columns
        EXPECT_NEAR(even.slope[i], 1.0f, 1e-5f);
    }
}

// Light that leaks to dark places takes as much of a wall's contrast as a flat curve would.
TEST(CameraColumns, WhatLeaksIsNoCurve)
{
    LitWall wall(0.03);
    for (size_t i = 0; i < wall.places(); ++i) {
        glm::vec3& shown = wall.model.shown[i];
        shown = glm::vec3(0.18f * std::pow(shown.g / 0.18f, static_cast<float>(1.0 / 0.85)));
    }
    const CameraColumns curved = columnsOf(Response{}, wall.asSeen());
    CameraColumns straight = evenSlope(curved);
    const auto evidence = [&](const CameraColumns& columns) {
        const LightEstimate light = wall.solve(columns);
        return light.nats + light.occam;
    };
    const double whole = evidence(straight) - evidence(curved); // for a curve
    straight.expected = {flattenedBy(0.9)};
    const double open = evidence(straight) - evidence(curved);
    EXPECT_GT(whole, 1.0);
    EXPECT_LT(open, 0.0);
    EXPECT_NEAR(wall.solve(straight).camera.front(), flattenedBy(0.9), 0.005);
}

// What leaks is told by the dark alone, and the dark tells most of the contrast. Where all is lit
// evenly nothing tells, and leaks are expected as ever.
TEST(CameraColumns, WhereNothingLeaksTheDarkTellsTheContrast)
{
    const std::vector<uint8_t> emits{1};
    for (const bool isDark : {false, true}) {
        LitWall wall(0.01, isDark ? 0.0005f : 1.0f);
        for (size_t i = 0; i < wall.places(); ++i) {
            glm::vec3& shown = wall.model.shown[i];
            shown = glm::vec3(0.18f * std::pow(shown.g / 0.18f, 1.35f));
        }
        const CameraColumns columns = columnsOf(Response{}, wall.asSeen());
        LightFit fit(wall.model, wall.pairs, {}, isDark ? kNoiseOfPaint : kFirstNoise);
        const LightEstimate first = fit.solve(emits, fit.beginning(), columns);
        fit.expectLeaks(first.log);
        const LightEstimate asUsual = fit.solve(emits, first.log, columns);
        fit.expectLeaks(first, columns);
        const LightEstimate found = fit.solve(emits, first.log, columns);
        const double narrower = found.cameraCovariance.front() / asUsual.cameraCovariance.front();
        if (!isDark) {
            EXPECT_GT(narrower, 0.95);
            continue;
        }
        EXPECT_LT(narrower, 0.5);
        EXPECT_NEAR(responseOf(found.camera).contrast(), 1.35f, 0.03f);
    }
}

// The exposure rises by half a stop from left to right, which no lamp explains.
TEST(CameraColumns, GainIsWhatNoLampExplains)
{
    LitWall wall(0.02);
    constexpr float kRise = 0.35f; // log, over the wall
    for (size_t i = 0; i < wall.places(); ++i)
        wall.model.shown[i] *= std::exp(kRise * (wall.positions[i].x / 4.0f - 0.5f));
    const Gain lattice = evenGainOver(wall.positions);
    ASSERT_FALSE(lattice.isOne());
    CameraColumns columns = columnsOf(lattice, wall.asSeen());
    columns.worth = 100.0;
    const Gain gain = gainOf(lattice, wall.solve(columns, 4.0).camera);
    const float found = std::log(gain.at({3.6f, 1.5f, 0}).g / gain.at({0.4f, 1.5f, 0}).g);
    EXPECT_NEAR(found, 0.8f * kRise, 0.1f * kRise);
}

// Brightness over half a metre to the power 0.6, as a camera does that shows a lamp and what lies
// in the shade of it.
TEST(CameraColumns, LocalToneMappingIsTheContrastOfWhatIsLarge)
{
    for (const float exponent : {0.6f, 1.0f}) {
        LitWall wall(0.02);
        const std::vector<float> even(wall.places(), 1.0f);
        std::vector<float> log;
        for (size_t i = 0; i < wall.places(); ++i)
            log.push_back(std::log(luminance(wall.model.shown[i])));
        const Gain light = meansOver(toneLatticeOver(wall.positions), wall.positions, log, even);
        for (size_t i = 0; i < wall.places(); ++i) {
            wall.model.shown[i] *=
                glm::pow(light.at(wall.positions[i]), glm::vec3(exponent - 1.0f));
            log[i] = std::log(luminance(wall.model.shown[i]));
        }
        const Gain around = meansOver(toneLatticeOver(wall.positions), wall.positions, log, even);
        CameraColumns columns = together(columnsOf(Response{}, wall.asSeen()),
                                         columnsOf(LocalTone{}, around, wall.asSeen()));
        columns.worth = 100.0; // the places are independent
        const LightEstimate found = wall.solve(columns);
        EXPECT_NEAR(localToneOf(around, found.camera.back()).exponent, exponent, 0.06f);
        EXPECT_NEAR(responseOf(found.camera).contrast(), 1.0f, 0.08f);
    }
}

// A result's lights.json must be read again, and its gains are within 12 stops.
TEST(CameraColumns, NoLocalToneMappingIsBeyondWhatAFileHolds)
{
    Gain around{.count = {2, 1, 1}, .log = {glm::vec3(-4.6f), glm::vec3(4.6f)}};
    const LocalTone tone = localToneOf(around, 50.0);
    EXPECT_NEAR(tone.exponent, 0.4f, 1e-6f);
    for (const glm::vec3 log : tone.gain.log) EXPECT_LT(std::abs(log.g), 12.0f * std::log(2.0f));
    EXPECT_NEAR(localToneOf(around, 1.0).gain.log[0].g, 4.6f, 1e-5f);
    EXPECT_EQ(localToneOf(around, -0.1), LocalTone{});
}

TEST(CameraColumns, EvidenceTellsDriftFromEvenLight)
{
    const auto evidence = [](float rise) { // nats for a gain
        LitWall wall(0.02);
        for (size_t i = 0; i < wall.places(); ++i)
            wall.model.shown[i] *= std::exp(rise * (wall.positions[i].x / 4.0f - 0.5f));
        const CameraColumns drift = columnsOf(evenGainOver(wall.positions), wall.asSeen());
        CameraColumns none;
        none.worth = drift.worth;
        const LightEstimate with = wall.solve(drift, 4.0);
        return wall.solve(none, 4.0).nats - with.nats - with.occam;
    };
    EXPECT_LT(evidence(0.0f), -3.0);
    EXPECT_GT(evidence(0.35f), 10.0);
}

TEST(CameraColumns, EvenLightHasNoGain)
{
    const LitWall wall(0.02);
    const Gain lattice = evenGainOver(wall.positions);
    const Gain gain = gainOf(lattice, wall.solve(columnsOf(lattice, wall.asSeen()), 4.0).camera);
    EXPECT_LT(gain.stops(), 0.1f);
}

TEST(CameraColumns, ACupboardHasNoLatticeAndAHallNoMoreKnotsThanARoom)
{
    const std::vector<glm::vec3> cupboard{{0, 0, 0}, {0.5f, 1.0f, 0.6f}};
    EXPECT_TRUE(evenGainOver(cupboard).isOne());
    EXPECT_TRUE(evenGainOver({}).isOne());
    const std::vector<glm::vec3> hall{{0, 0, 0}, {80.0f, 12.0f, 1000.0f}};
    EXPECT_LE(evenGainOver(hall).log.size(), 250u);
}

// As fits beside a drift have them, in rooms of Blender and of bench/rooms.
TEST(CameraColumns, BracketsAreFlatAndLeaksAndPhonesAreNot)
{
    EXPECT_TRUE(isFlattening(std::vector{-0.070, -0.111, 0.117, 0.165, 0.383}));
    EXPECT_FALSE(isFlattening(std::vector{-0.343, -0.236, -0.273, -0.110, 0.230}));
    EXPECT_FALSE(isFlattening(std::vector{-0.195, -0.194, -0.175, -0.032, 0.219}));
}

// Of a curve of slope 1.4 that is as likely as none, half is undone, and the truth lies 0.2 to
// either side; where nothing of it is undone it lies at one end.
TEST(CameraColumns, ACurveThatIsHalfLikelyIsInDoubtByHalf)
{
    LightEstimate fit{.camera = std::vector<double>(Response::kKnots, 0.4)};
    fit.cameraCovariance.assign(Response::kKnots * Response::kKnots, 0.0);
    EXPECT_NEAR(std::sqrt(doubtOfResponse(fit, 0.5, 0.5).front()), 0.2f, 1e-6f);
    EXPECT_NEAR(std::sqrt(doubtOfResponse(fit, 0.25, 0.0).back()), 0.2f, 1e-6f);
    EXPECT_EQ(doubtOfResponse(fit, 1.0, 1.0), SlopeCovariance{});
    fit.cameraCovariance.assign(Response::kKnots * Response::kKnots, 0.01);
    EXPECT_NEAR(std::sqrt(doubtOfResponse(fit, 1.0, 1.0)[1]), 0.1f, 1e-6f);
}

} // namespace relamp
