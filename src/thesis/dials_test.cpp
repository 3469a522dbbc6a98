#include "thesis/dials.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

/// Walls of two paints under shading 0.1..2 and a hidden ambient light.
std::vector<DialSample> room(float power, float ambient)
{
    std::vector<DialSample> samples;
    for (int i = 0; i < 400; ++i) {
        const float lit = 0.1f + 1.9f * std::abs(std::sin(static_cast<float>(i)));
        const float albedo = i % 10 == 0 ? 0.9f : 0.5f;
        samples.push_back({glm::vec3(albedo * (power * lit + ambient)), glm::vec3(lit), 0.01f});
    }
    return samples;
}

} // namespace

TEST(Dials, FindTheAmbientThatMakesWallsUniform)
{
    const Dials dials = fitDials(room(0.4f, 0.2f), {}, {});
    EXPECT_NEAR(dials.ambient, 0.2f, 0.04f);
    EXPECT_NEAR(dials.power, 0.4f, 0.04f);
}

TEST(Dials, MakeTheBrightestThingNineTenthsWhite)
{
    const std::vector<DialSample> samples = room(3.0f, 0.0f);
    const Dials dials = fitDials(samples, {}, 0.0f);
    EXPECT_EQ(dials.ambient, 0.0f);
    EXPECT_NEAR(dials.power, 3.0f, 0.05f);
}

// Whichever of the two a person sets, the other finds its place beside it.
TEST(Dials, OneGivenDialIsKeptAndTheOtherFollows)
{
    const std::vector<DialSample> samples = room(0.4f, 0.2f);
    const Dials byPower = fitDials(samples, 0.4f, {});
    EXPECT_EQ(byPower.power, 0.4f);
    EXPECT_NEAR(byPower.ambient, 0.2f, 0.04f);
    const Dials byAmbient = fitDials(samples, {}, 0.2f);
    EXPECT_EQ(byAmbient.ambient, 0.2f);
    EXPECT_NEAR(byAmbient.power, 0.4f, 0.04f);
    const Dials both = fitDials(samples, 3.0f, 0.5f);
    EXPECT_EQ(both.power, 3.0f);
    EXPECT_EQ(both.ambient, 0.5f);
}

TEST(Dials, ARoomWithoutLightKeepsPowerFinite)
{
    const std::vector<DialSample> dark(10, {glm::vec3(0.0f), glm::vec3(0.0f), 0.01f});
    const Dials dials = fitDials(dark, {}, {});
    EXPECT_TRUE(std::isfinite(dials.power));
    EXPECT_TRUE(std::isfinite(fitDials({}, {}, {}).power));
}

} // namespace relamp
