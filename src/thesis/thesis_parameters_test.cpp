#include "thesis/thesis_parameters.h"

#include "base/radiometry.shared.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

/// Walls of two paints under shading 0.1..2 and a hidden ambient light.
std::vector<ParameterSample> room(float power, float ambient)
{
    std::vector<ParameterSample> samples;
    for (int i = 0; i < 400; ++i) {
        const float lit = 0.1f + 1.9f * std::abs(std::sin(static_cast<float>(i)));
        const float albedo = i % 10 == 0 ? kWhitePaint : 0.5f;
        samples.push_back({glm::vec3(albedo * (power * lit + ambient)), glm::vec3(lit), 0.01f});
    }
    return samples;
}

} // namespace

TEST(ThesisParameters, FindTheAmbientThatMakesWallsUniform)
{
    const FittedParameters parameters = fitParameters(room(0.4f, 0.2f), {}, {});
    EXPECT_NEAR(parameters.ambient, 0.2f, 0.04f);
    EXPECT_NEAR(parameters.power, 0.4f, 0.04f);
}

TEST(ThesisParameters, MakeTheBrightestThingNineTenthsWhite)
{
    const std::vector<ParameterSample> samples = room(3.0f, 0.0f);
    const FittedParameters parameters = fitParameters(samples, {}, 0.0f);
    EXPECT_EQ(parameters.ambient, 0.0f);
    EXPECT_NEAR(parameters.power, 3.0f, 0.05f);
}

// Whichever of the two a person sets, the other finds its place beside it.
TEST(ThesisParameters, OneGivenParameterIsKeptAndTheOtherFollows)
{
    const std::vector<ParameterSample> samples = room(0.4f, 0.2f);
    const FittedParameters byPower = fitParameters(samples, 0.4f, {});
    EXPECT_EQ(byPower.power, 0.4f);
    EXPECT_NEAR(byPower.ambient, 0.2f, 0.04f);
    const FittedParameters byAmbient = fitParameters(samples, {}, 0.2f);
    EXPECT_EQ(byAmbient.ambient, 0.2f);
    EXPECT_NEAR(byAmbient.power, 0.4f, 0.04f);
    const FittedParameters both = fitParameters(samples, 3.0f, 0.5f);
    EXPECT_EQ(both.power, 3.0f);
    EXPECT_EQ(both.ambient, 0.5f);
}

TEST(ThesisParameters, ARoomWithoutLightKeepsPowerFinite)
{
    const std::vector<ParameterSample> dark(10, {glm::vec3(0.0f), glm::vec3(0.0f), 0.01f});
    const FittedParameters parameters = fitParameters(dark, {}, {});
    EXPECT_TRUE(std::isfinite(parameters.power));
    EXPECT_TRUE(std::isfinite(fitParameters({}, {}, {}).power));
}

} // namespace relamp
