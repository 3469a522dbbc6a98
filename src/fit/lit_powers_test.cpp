#include "base/radiometry.shared.h"
#include "fit/lit_powers.h"

#include <random>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr size_t kPlaces = 600;

/// A floor of one paint under a lamp of radiance 40; a third of it lies in the dark.
struct DarkCorners
{
    FitData data;
    std::vector<MaterialPair> pairs;

    /// `stray`: irradiance that the model has too much of, in the dark.
    explicit DarkCorners(float stray)
    {
        std::mt19937 random(5);
        const auto between = [&](float low, float high) {
            return low + (high - low) * static_cast<float>(random() >> 8) / 16777216.0f;
        };
        data.lamps = 1;
        for (size_t i = 0; i < kPlaces; ++i) {
            const bool isDark = i % 3 == 0;
            const float gathered = isDark ? between(0.1f, 0.2f) : between(0.4f, 0.6f);
            const float direct = isDark ? 0.0f : between(0.005f, 0.05f);
            data.radiance.emplace_back(0.6f / kPi * (gathered + 40.0f * direct));
            data.gathered.emplace_back(gathered + (isDark ? stray : 0.0f));
            data.missed.push_back(0.0f);
            data.direct.push_back(direct);
        }
        for (size_t i = 0; i < 8 * kPlaces; ++i)
            pairs.push_back({static_cast<uint32_t>(random() % kPlaces),
                             static_cast<uint32_t>(random() % kPlaces)});
    }
};

float powerOf(const Powers& powers)
{
    return powers.radiance[0].g;
}

} // namespace

TEST(LitPowers, StrayLightInTheDarkDoesNotMakeLampsStronger)
{
    const DarkCorners corners(0.05f);
    const float areas[] = {1.0f};
    EXPECT_GT(powerOf(fitPowers(corners.data, corners.pairs)), 50.0f);
    EXPECT_NEAR(powerOf(fitLitPowers(corners.data, corners.pairs, areas)), 40.0f, 1.0f);
}

// Where dark places ask for weaker lamps, it is no light through gaps, and they are heard.
TEST(LitPowers, DarkPlacesThatMakeLampsWeakerAreHeard)
{
    const DarkCorners corners(-0.05f);
    const float areas[] = {1.0f};
    const Powers all = fitPowers(corners.data, corners.pairs);
    EXPECT_LT(powerOf(all), 35.0f);
    EXPECT_FLOAT_EQ(powerOf(fitLitPowers(corners.data, corners.pairs, areas)), powerOf(all));
}

TEST(LitPowers, FewLitPairsAreNotBelieved)
{
    DarkCorners corners(0.05f);
    std::erase_if(corners.pairs, [](MaterialPair pair) {
        return pair.p % 3 != 0 && pair.q % 3 != 0 && pair.p > kPlaces / 20;
    });
    const float areas[] = {1.0f};
    const float all = powerOf(fitPowers(corners.data, corners.pairs));
    EXPECT_FLOAT_EQ(powerOf(fitLitPowers(corners.data, corners.pairs, areas)), all);
}

TEST(LitPowers, WithoutPlacesNothingIsKnown)
{
    const float areas[] = {1.0f};
    EXPECT_NEAR(powerOf(fitLitPowers({.lamps = 1}, {}, areas)), 1.0f, 1e-3f);
}

} // namespace relamp
