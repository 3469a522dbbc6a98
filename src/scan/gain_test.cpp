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
                gain.log.emplace_back(-1.0f + 0.5f * static_cast<float>(x) +
                                      0.5f * static_cast<float>(2 * y) - 2.0f -
                                      0.5f * static_cast<float>(z));
    return gain;
}

} // namespace

TEST(Gain, IsLinearBetweenItsKnotsAndConstantBeyond)
{
    const Gain gain = slope();
    const auto log = [&](glm::vec3 p) { return std::log(gain.at(p).g); };
    EXPECT_NEAR(log({-0.7f, 0.9f, 2.2f}), -0.7f + 1.8f - 2.2f, 1e-5f);
    EXPECT_NEAR(log({0.0f, 1.5f, 2.5f}), 0.0f + 3.0f - 2.5f, 1e-5f);
    EXPECT_NEAR(log({-9.0f, 9.0f, 0.0f}), log({-1.0f, 1.5f, 2.0f}), 1e-6f);
    EXPECT_NEAR(gain.stops(), (1.0f + 3.0f + 0.5f) / std::log(2.0f), 1e-5f);
    EXPECT_EQ(Gain{}.at({1, 2, 3}), glm::vec3(1.0f));
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

TEST(Gain, MeansOverALatticeAreThoseAroundEachKnot)
{
    std::vector<glm::vec3> positions;
    std::vector<float> log;
    for (int i = 0; i <= 40; ++i) {
        positions.emplace_back(0.1f * static_cast<float>(i), 0.0f, 0.0f);
        log.push_back(i < 20 ? -1.0f : 3.0f);
    }
    const std::vector<float> even(log.size(), 1.0f);
    const Gain means = meansOver(latticeOver(positions, 1.0f, 100), positions, log, even);
    EXPECT_NEAR(means.log.front().g, -1.0f, 1e-5f);
    EXPECT_NEAR(means.log.back().b, 3.0f, 1e-5f);
    EXPECT_NEAR(std::log(means.at({2.0f, 0, 0}).r), 1.0f, 0.25f); // half of both
    std::vector<float> left(log.size(), 0.0f);
    std::fill_n(left.begin(), 20, 1.0f);
    const Gain dark = meansOver(latticeOver(positions, 1.0f, 100), positions, log, left);
    EXPECT_NEAR(dark.at({2.0f, 0, 0}).g, std::exp(-1.0f), 1e-5f);
}

// By where they lie: the second gain is that of the first room.
TEST(Linearization, EveryRoomHasTheGainAroundIt)
{
    Surfels surfels;
    std::vector<uint8_t> rooms;
    for (int i = 0; i < 100; ++i) {
        rooms.push_back(i < 50 ? 0 : 1);
        surfels.position.emplace_back(static_cast<float>(i) * 0.1f, 0.0f, 0.0f);
        surfels.area.push_back(0.01f);
    }
    surfels.position[49].x = 9.0f; // one that went astray
    const glm::vec3 dark(-1.0f);
    const glm::vec3 bright(0.5f);
    CameraModel camera;
    camera.gains = {{{5.0f, 0, 0}, 5.0f, {2, 1, 1}, {dark, dark}},
                    {{0.0f, 0, 0}, 5.0f, {2, 1, 1}, {bright, bright}}};
    const Linearization linearization = linearizationOf(camera, surfels, rooms);
    ASSERT_EQ(linearization.perGain.size(), surfels.count());
    for (size_t s = 0; s < rooms.size(); ++s)
        EXPECT_NEAR(linearization.perGain[s].g, std::exp(rooms[s] == 0 ? -0.5f : 1.0f), 1e-5f);
    EXPECT_NEAR(camera.stops(), 0.0f, 1e-6f);
    camera.gains.resize(1);
    for (const glm::vec3 perGain : linearizationOf(camera, surfels, rooms).perGain)
        EXPECT_NEAR(perGain.g, std::exp(1.0f), 1e-5f); // of a file from before there were rooms
}

} // namespace relamp
