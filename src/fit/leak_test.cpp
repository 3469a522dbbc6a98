#include "base/radiometry.shared.h"
#include "fit/leak.h"

#include <random>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr size_t kCornerPlaces = 600;

/// A floor of one paint under a lamp of radiance 40; a third of it lies in the dark.
struct DarkCorners
{
    FitData data;
    std::vector<MaterialPair> pairs;

    /// `leaked`: irradiance that the model has too much of at a dark place, at most.
    explicit DarkCorners(float leaked)
    {
        std::mt19937 random(5);
        const auto between = [&](float low, float high) {
            return low + (high - low) * static_cast<float>(random() >> 8) / 16777216.0f;
        };
        data.lamps = 1;
        for (size_t i = 0; i < kCornerPlaces; ++i) {
            const bool isDark = i % 3 == 0;
            const float gathered = isDark ? between(0.1f, 0.2f) : between(0.4f, 0.6f);
            const float direct = isDark ? 0.0f : between(0.005f, 0.05f);
            data.radiance.emplace_back(0.6f / kPi * (gathered + 40.0f * direct));
            data.gathered.emplace_back(gathered + (isDark ? between(0.0f, leaked) : 0.0f));
            data.missed.push_back(0.0f);
            data.direct.push_back(direct);
        }
        for (size_t i = 0; i < 8 * kCornerPlaces; ++i)
            pairs.push_back({static_cast<uint32_t>(random() % kCornerPlaces),
                             static_cast<uint32_t>(random() % kCornerPlaces)});
    }
};

PowersOptions leaking(double leak)
{
    PowersOptions options;
    options.leak = leak;
    return options;
}

} // namespace

// Through a gap light gets into a corner that was dark in the room; what is lit would have to be as
// much brighter.
TEST(Leak, LightThroughGapsDoesNotMakeLampsStronger)
{
    const DarkCorners corners(0.2f);
    const double leak = findLeak(corners.data, corners.pairs, {});
    EXPECT_GT(leak, 0.0);
    const float without = fitPowers(corners.data, corners.pairs).radiance[0].g;
    const float with = fitPowers(corners.data, corners.pairs, leaking(leak)).radiance[0].g;
    EXPECT_GT(without, 60.0f);
    EXPECT_LT(with, 48.0f);
}

// A gap brings light and takes none away.
TEST(Leak, DarkPlacesThatGetTooLittleAreHeard)
{
    const DarkCorners corners(-0.05f);
    EXPECT_LT(fitPowers(corners.data, corners.pairs, leaking(0.05)).radiance[0].g, 36.0f);
}

TEST(Leak, WholeMeshHasNone)
{
    const DarkCorners corners(0.0f);
    EXPECT_EQ(findLeak(corners.data, corners.pairs, {}), 0.0);
}

TEST(Leak, WithoutPlacesNothingIsKnown)
{
    const FitData none{.lamps = 1};
    EXPECT_EQ(findLeak(none, {}, {}), 0.0);
}

} // namespace relamp
