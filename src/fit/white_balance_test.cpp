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

    /// Red rises by `rise` (log) from left to right.
    explicit TintedFloor(float rise)
    {
        std::mt19937 random(7);
        const auto unit = [&] { return static_cast<float>(random() >> 8) / 16777216.0f; };
        for (int i = 0; i < 3000; ++i) {
            position.emplace_back(6.0f * unit(), 0.0f, 6.0f * unit());
            const glm::vec3 paint = i % 2 == 0 ? glm::vec3(0.6f, 0.5f, 0.4f) : glm::vec3(0.2f);
            const float noise = std::exp(0.02f * (unit() - 0.5f));
            albedo.push_back(
                paint * glm::vec3(noise * std::exp(rise * position.back().x / 6.0f), 1.0f, 1.0f));
        }
        for (int i = 0; i < 9000; ++i) {
            const auto p = static_cast<uint32_t>(random() % 3000);
            const auto q = static_cast<uint32_t>(random() % 3000);
            const bool isOnePaint = p % 2 == q % 2 || i % 4 == 0; // some are mistaken for that
            if (p != q && isOnePaint) pairs.push_back({p, q});
        }
    }

    [[nodiscard]] Gain found() const
    {
        return withWhiteBalance(latticeOver(position, 1.2f, 120), position, albedo, pairs);
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

TEST(WhiteBalance, PaintsAloneMakeNoDrift)
{
    const Gain gain = TintedFloor(0.0f).found();
    for (const float x : {0.5f, 3.0f, 5.5f})
        EXPECT_NEAR(redOverGreen(gain.at({x, 0, 3})), 0.0f, 0.005f);
}

} // namespace relamp
