#include "fit/white_balance.h"

#include "base/radiometry.shared.h"
#include "scan/gain.h"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

/// Two paints, mixed all over a floor of 6 x 6 m.
struct TintedFloor
{
    std::vector<glm::vec3> position;
    std::vector<glm::vec3> albedo;
    std::vector<MaterialPair> pairs;

    /// Red rises by `rise` (log) from left to right; `noise` (log): of single places.
    explicit TintedFloor(float rise, float noise = 0.02f)
    {
        std::mt19937 random(7);
        const auto unit = [&] { return static_cast<float>(random() >> 8) / 16777216.0f; };
        for (int i = 0; i < 3000; ++i) {
            const float x = 6.0f * unit(); // one after the other, whatever the compiler
            position.emplace_back(x, 0.0f, 6.0f * unit());
            const glm::vec3 paint = i % 2 == 0 ? glm::vec3(0.6f, 0.5f, 0.4f) : glm::vec3(0.2f);
            const float off = std::exp(noise * (unit() - 0.5f));
            albedo.push_back(paint * glm::vec3(off * std::exp(rise * x / 6.0f), 1.0f, 1.0f));
        }
        for (int i = 0; i < 9000; ++i) {
            const auto p = static_cast<uint32_t>(random() % 3000);
            const auto q = static_cast<uint32_t>(random() % 3000);
            const bool isOnePaint = p % 2 == q % 2 || i % 4 == 0; // some are mistaken for that
            if (p != q && isOnePaint) pairs.push_back({p, q});
        }
    }

    [[nodiscard]] Gain found(double exposureDrifted = 0.0) const
    {
        return withWhiteBalance(latticeOver(position, 1.2f, 120), position, albedo, pairs, {},
                                {exposureDrifted, 75.0});
    }
};

float redOverGreen(glm::vec3 gain)
{
    return std::log(gain.r / gain.g);
}

} // namespace

TEST(WhiteBalance, DriftOfOneColorIsFoundAndItsBrightnessStays)
{
    constexpr float kRise = 0.12f;
    const Gain gain = TintedFloor(kRise).found();
    const glm::vec3 left = gain.at({0.3f, 0, 3});
    const glm::vec3 right = gain.at({5.7f, 0, 3});
    EXPECT_NEAR(redOverGreen(right) - redOverGreen(left), 0.9f * kRise, 0.1f * kRise);
    EXPECT_NEAR(luminance(right) / luminance(left), 1.0f, 0.005f);
    EXPECT_NEAR(std::log(right.b / right.g), std::log(left.b / left.g), 0.01f);
}

// A rise that is small beside what places differ by is no evidence; with exposure that drifted it
// counts.
TEST(WhiteBalance, WhatIsUnlikelyToBeADriftIsNone)
{
    constexpr float kRise = 0.02f;
    const TintedFloor floor(kRise, 0.4f);
    const auto rise = [](const Gain& gain) {
        return redOverGreen(gain.at({5.7f, 0, 3})) - redOverGreen(gain.at({0.3f, 0, 3}));
    };
    EXPECT_LT(rise(floor.found()), 0.35f * kRise);
    EXPECT_GT(rise(floor.found(1.0)), 0.6f * kRise);
}

TEST(WhiteBalance, PaintsAloneMakeNoDrift)
{
    const Gain gain = TintedFloor(0.0f).found();
    for (const float x : {0.5f, 3.0f, 5.5f})
        EXPECT_NEAR(redOverGreen(gain.at({x, 0, 3})), 0.0f, 0.005f);
}

} // namespace relamp
