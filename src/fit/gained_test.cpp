#include "base/radiometry.shared.h"
#include "fit/gained.h"

#include <cmath>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr float kRadiance = 20.0f; // of the lamp that the fit does without

/// A grey floor whose left half lies under a lamp of a fit, and its middle under one more.
struct LitFloor
{
    FitData data{.lamps = 1};
    std::vector<MaterialPair> pairs;
    Powers powers{.radiance = {glm::vec3(5.0f)}};
    std::vector<float> left;
    std::vector<float> middle;
    std::vector<float> right;

    LitFloor()
    {
        for (uint32_t i = 0; i < 90; ++i) {
            const float falloff = 0.02f + 0.001f * static_cast<float>(i % 15);
            left.push_back(i < 45 ? falloff : 0.0f);
            middle.push_back(i >= 30 && i < 60 ? falloff : 0.0f);
            right.push_back(i >= 60 ? falloff : 0.0f);
            data.direct.push_back(left[i]);
            data.gathered.emplace_back(0.2f);
            data.missed.push_back(0.0f);
            data.radiance.emplace_back(0.5f * (0.2f + 5.0f * left[i] + kRadiance * middle[i]) /
                                       kPi);
            pairs.push_back({i, (i * 37 + 11) % 90});
        }
    }

    [[nodiscard]] std::vector<Gain> of(std::initializer_list<std::span<const float>> direct) const
    {
        return gained(data, pairs, powers, std::vector(direct));
    }
};

} // namespace

// The light of one lamp is missing from the model, and only where that lamp shines.
TEST(Gained, LampThatIsMissingIsWorthMuchAndItsLightIsKnownRoughly)
{
    const LitFloor floor;
    const std::vector<Gain> gains = floor.of({floor.left, floor.middle, floor.right});
    EXPECT_GT(gains[1].loss, 0.5f);
    EXPECT_NEAR(std::log(gains[1].radiance / kRadiance), 0.0f, std::log(3.0f));
    EXPECT_EQ(gains[2].loss, 0.0f);
    EXPECT_LT(gains[0].loss, 0.1f * gains[1].loss);
}

TEST(Gained, NothingIsGainedWhereAllLightIsKnownNorByWhatLightsNothing)
{
    LitFloor floor;
    floor.data.lamps = 2;
    floor.data.direct.clear();
    for (size_t i = 0; i < floor.left.size(); ++i)
        floor.data.direct.insert(floor.data.direct.end(), {floor.left[i], floor.middle[i]});
    floor.powers.radiance.emplace_back(kRadiance);
    const std::vector<float> nothing(floor.left.size(), 0.0f);
    for (const Gain& gain : floor.of({floor.left, floor.middle, floor.right, nothing}))
        EXPECT_EQ(gain.loss, 0.0f);
}

} // namespace relamp
