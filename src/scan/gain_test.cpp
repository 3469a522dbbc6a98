#include "scan/gain.h"

#include "scan/linearization.h"

#include <cmath>
#include <numeric>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

/// Whose logarithm is `x + 2y - z` at its knots.
Gain slope()
{
    Gain gain{.origin = {-1.0f, 0.0f, 2.0f}, .spacing = 0.5f, .count = {3, 4, 2}};
    for (int z = 0; z < 2; ++z)
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 3; ++x)
                gain.log.push_back(-1.0f + 0.5f * static_cast<float>(x) + static_cast<float>(y) -
                                   2.0f - 0.5f * static_cast<float>(z));
    return gain;
}

} // namespace

TEST(Gain, IsLinearBetweenItsKnotsAndConstantBeyond)
{
    const Gain gain = slope();
    const auto log = [&](glm::vec3 p) { return std::log(gain.at(p)); };
    EXPECT_NEAR(log({-0.7f, 0.9f, 2.2f}), -0.7f + 1.8f - 2.2f, 1e-5f);
    EXPECT_NEAR(log({0.0f, 1.5f, 2.5f}), 0.0f + 3.0f - 2.5f, 1e-5f);
    EXPECT_NEAR(log({-9.0f, 9.0f, 0.0f}), log({-1.0f, 1.5f, 2.0f}), 1e-6f);
    EXPECT_NEAR(gain.stops(), (1.0f + 3.0f + 0.5f) / std::log(2.0f), 1e-5f);
    EXPECT_EQ(Gain{}.at({1, 2, 3}), 1.0f);
}

TEST(Gain, WeightsAreSharesOfKnotsThatAreThere)
{
    const Gain gain = slope();
    for (const glm::vec3 p :
         {glm::vec3(-1, 0, 2), glm::vec3(5, 5, 5), glm::vec3(-0.3f, 0.2f, 2.1f)}) {
        const GainWeights weights = weightsAt(gain, p);
        EXPECT_NEAR(std::accumulate(weights.part.begin(), weights.part.end(), 0.0f), 1.0f, 1e-6f);
        for (const uint32_t knot : weights.knot) EXPECT_LT(knot, gain.log.size());
    }
}

TEST(Linearization, LeavesWhatIsBurntOutAndBurnsNothingOut)
{
    EXPECT_EQ(withoutGain({0.98f, 0.5f, 0.2f}, 0.7f), glm::vec3(0.98f, 0.5f, 0.2f));
    EXPECT_EQ(withoutGain({0.4f, 0.2f, 0.1f}, 0.5f), glm::vec3(0.2f, 0.1f, 0.05f));
    EXPECT_LT(withoutGain({0.9f, 0.2f, 0.1f}, 2.0f).r, 0.97f);
}

} // namespace relamp
