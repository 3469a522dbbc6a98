#include "thesis/direct.h"

#include "scenes/surfaces.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr glm::vec3 kInverseSquare(0.0f, 0.0f, 1.0f);

float irradianceAt(glm::vec3 position, glm::vec3 normal, glm::vec3 attenuation = kInverseSquare)
{
    const PointLight light{.position = {0, 2, 0}, .intensity = {10, 0, 0}};
    TexelBlock block;
    scenes::addTexel(block, position, normal);
    RgbBlock out;
    directIrradiance(block, LightArrays({&light, 1}), attenuation, out);
    return out.r[0];
}

} // namespace

TEST(Direct, FallsOffWithTheSquareOfTheDistance)
{
    const glm::vec3 up(0, 1, 0);
    EXPECT_NEAR(irradianceAt({0, 1, 0}, up), 10.0f, 1e-4f);
    EXPECT_NEAR(irradianceAt({0, 0, 0}, up), 2.5f, 1e-5f);
    EXPECT_NEAR(irradianceAt({0, -2, 0}, up), 10.0f / 16.0f, 1e-6f);
}

TEST(Direct, FollowsTheCosineAndIsDarkBehind)
{
    const float tilted = std::sqrt(0.5f);
    EXPECT_NEAR(irradianceAt({0, 1, 0}, {tilted, tilted, 0}), 10.0f * tilted, 1e-4f);
    EXPECT_EQ(irradianceAt({0, 1, 0}, {0, -1, 0}), 0.0f);
}

TEST(Direct, AttenuatesAsTheThesisDoes)
{
    // 1 / (k0 + k1 d + k2 d^2) at two metres
    EXPECT_NEAR(irradianceAt({0, 0, 0}, {0, 1, 0}, {1.0f, 0.5f, 0.25f}), 10.0f / 3.0f, 1e-5f);
}

TEST(Direct, LightOnTheSurfaceItselfStaysFinite)
{
    EXPECT_TRUE(std::isfinite(irradianceAt({0, 2, 0}, {0, 1, 0}, {0.01f, 0.0f, 1.0f})));
}

TEST(Direct, IsTheSameForAllInstructionSets)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<float> metres(0.0f, 5.0f);
    std::vector<PointLight> lights(37);
    for (PointLight& light : lights) {
        light.position = {metres(random), metres(random), metres(random)};
        light.intensity = {metres(random), metres(random), metres(random)};
    }
    TexelBlock block;
    for (int i = 0; i < 501; ++i)
        scenes::addTexel(
            block, {metres(random), metres(random), metres(random)},
            glm::normalize(glm::vec3(metres(random), metres(random), metres(random)) - 2.5f));
    const LightArrays arrays(lights);
    RgbBlock narrow;
    directIrradiance(block, arrays, {0.01f, 0.0f, 1.0f}, narrow, InstructionSet::baseline);
    for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
        if (set > bestInstructionSet()) continue;
        RgbBlock wide;
        directIrradiance(block, arrays, {0.01f, 0.0f, 1.0f}, wide, set);
        for (size_t i = 0; i < block.count; ++i) {
            EXPECT_NEAR(wide.r[i], narrow.r[i], 1e-5f * narrow.r[i]);
            EXPECT_NEAR(wide.b[i], narrow.b[i], 1e-5f * narrow.b[i]);
        }
    }
}

} // namespace relamp
