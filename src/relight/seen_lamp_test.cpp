#include "relight/seen_lamp.h"

#include <cmath>

#include <glm/gtc/constants.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

/// Irradiance at the origin, facing up, of what is seen there: the integral of radiance times
/// cosine over the sky, by the midpoint rule.
float irradianceOfGlow(const NewLight& light)
{
    constexpr int kSteps = 1200;
    const SeenLamp lamp(light);
    const float reach = 0.3f; // of the sky in which the light is, as tangents
    float sum = 0.0f;
    for (int j = 0; j < kSteps; ++j)
        for (int i = 0; i < kSteps; ++i) {
            const float x = reach * (2.0f * (static_cast<float>(i) + 0.5f) / kSteps - 1.0f);
            const float z = reach * (2.0f * (static_cast<float>(j) + 0.5f) / kSteps - 1.0f);
            const float squared = 1.0f + x * x + z * z;
            const glm::vec3 direction = glm::vec3(x, 1.0f, z) / std::sqrt(squared);
            if (const auto glow = lamp.along({.direction = direction}))
                sum += glow->radiance.g / (squared * squared); // cosine and solid angle
        }
    const float step = 2.0f * reach / kSteps;
    return sum * step * step;
}

} // namespace

// What a lamp looks like is what it does: the light that comes from where it is seen is the light
// that it sheds. Two metres above, E = I / 4, and for panels pi L sin^2 or L A / d^2.
TEST(SeenLamp, LooksAsBrightAsItShines)
{
    const NewLight sphere{.type = LightType::sphere,
                          .emission = glm::vec3(5.0f),
                          .position = {0.0f, 2.0f, 0.0f},
                          .radius = 0.1f};
    const float intensity = 5.0f * glm::pi<float>() * 0.01f;
    EXPECT_NEAR(irradianceOfGlow(sphere), intensity / 4.0f, 0.01f * intensity);

    NewLight bulb = sphere;
    bulb.type = LightType::point;
    EXPECT_NEAR(irradianceOfGlow(bulb), 5.0f / 4.0f, 0.02f);

    NewLight disc = sphere;
    disc.type = LightType::disc;
    EXPECT_NEAR(irradianceOfGlow(disc), 5.0f * glm::pi<float>() * 0.01f / 4.01f, 1e-3f);

    NewLight panel = sphere;
    panel.type = LightType::rectangle;
    panel.size = {0.3f, 0.2f};
    EXPECT_NEAR(irradianceOfGlow(panel), 5.0f * 0.06f / 4.0f, 1e-3f);
}

TEST(SeenLamp, BacksPointsAndSunsAreNotSeen)
{
    const Ray up{.direction = {0.0f, 1.0f, 0.0f}};
    NewLight disc{.type = LightType::disc,
                  .emission = glm::vec3(1.0f),
                  .position = {0.0f, 2.0f, 0.0f},
                  .radius = 0.1f};
    ASSERT_TRUE(SeenLamp(disc).along(up));
    EXPECT_FLOAT_EQ(SeenLamp(disc).along(up)->distance, 2.0f);
    disc.direction = {0.0f, 1.0f, 0.0f};
    EXPECT_FALSE(SeenLamp(disc).along(up));

    EXPECT_FALSE(SeenLamp::hasSurface({.emission = glm::vec3(1.0f)}));
    EXPECT_FALSE(SeenLamp::hasSurface({.type = LightType::sun, .emission = glm::vec3(1.0f)}));
    EXPECT_FALSE(SeenLamp::hasSurface({.type = LightType::sphere, .radius = 1.0f})); // dark
}

} // namespace relamp
