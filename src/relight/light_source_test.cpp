#include "relight/light_source.h"

#include "base/radiometry.shared.h"
#include "scenes/axes.h"
#include "scenes/radiosity.h"
#include "scenes/scenes.h"
#include "scenes/surfaces.h"

#include <cmath>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::kUp;

/// Irradiance on a floor at `place`, nothing in the way.
float onFloor(const LightSource& light, glm::vec3 place,
              InstructionSet set = InstructionSet::baseline)
{
    TexelBlock block;
    scenes::addTexel(block, place, kUp);
    float irradiance[TexelBlock::kPadded];
    light.open(block, irradiance, set);
    return irradiance[0];
}

/// The same by looks at the light.
float byLooks(const LightSource& light, glm::vec3 place)
{
    constexpr int kLooks = 4096;
    double sum = 0.0;
    for (int i = 0; i < kLooks; ++i) {
        const float share = (static_cast<float>(i) + 0.5f) / kLooks;
        const glm::vec2 u(glm::fract(0.754877f * static_cast<float>(i)),
                          glm::fract(0.569840f * static_cast<float>(i)));
        sum += static_cast<double>(light.look(place, kUp, share, u).irradiance);
    }
    return static_cast<float>(sum / kLooks);
}

NewLight above(LightType type, float height)
{
    NewLight light;
    light.type = type;
    light.position = {0.0f, height, 0.0f};
    return light;
}

} // namespace

TEST(LightSource, PointFallsOffByTheInverseSquareAndTheCosine)
{
    const LightSource light(above(LightType::point, 2.0f));
    EXPECT_NEAR(onFloor(light, {0, 0, 0}), 0.25f, 1e-6f);
    EXPECT_NEAR(onFloor(light, {0, 1, 0}), 1.0f, 1e-6f);
    EXPECT_NEAR(onFloor(light, {2, 0, 0}), std::sqrt(0.5f) / 8.0f, 1e-6f);
    EXPECT_EQ(onFloor(light, {0, 3, 0}), 0.0f); // from behind
}

TEST(LightSource, SpotShinesWithinItsConeAndFadesAtItsEdge)
{
    NewLight spot = above(LightType::spot, 1.0f);
    spot.cone = 0.5f;
    spot.blend = 0.2f;
    const LightSource light(spot);
    const LightSource point(above(LightType::point, 1.0f));
    const auto share = [&](float angle) {
        const glm::vec3 place(std::tan(angle), 0, 0);
        return onFloor(light, place) / onFloor(point, place);
    };
    EXPECT_NEAR(share(0.0f), 1.0f, 1e-5f);
    EXPECT_NEAR(share(0.39f), 1.0f, 1e-4f);
    EXPECT_GT(share(0.45f), 0.1f);
    EXPECT_LT(share(0.45f), 0.9f);
    EXPECT_EQ(share(0.51f), 0.0f);
}

TEST(LightSource, RectangleIsLambertsPolygon)
{
    NewLight lamp = above(LightType::rectangle, 2.0f);
    lamp.size = {1.0f, 0.6f};
    lamp.along = {1.0f, 0.0f, 0.0f};
    const LightSource light(lamp);
    const scenes::Panel panel{{-0.5f, 2.0f, -0.3f}, {1, 0, 0}, {0, 0, 0.6f}};
    for (const glm::vec3 place :
         {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0.5f), glm::vec3(0, 1.2f, 0)}) {
        const float exact = scenes::irradianceFrom(panel, place, kUp);
        EXPECT_NEAR(onFloor(light, place), exact, 0.01f * exact);
    }
}

TEST(LightSource, DiscOnItsAxisIsTheClosedFormula)
{
    NewLight lamp = above(LightType::disc, 1.0f);
    lamp.radius = 0.3f;
    const float exact = kPi * 0.09f / (0.09f + 1.0f); // pi L r^2 / (r^2 + h^2)
    EXPECT_NEAR(onFloor(LightSource(lamp), {0, 0, 0}), exact, 0.01f * exact);
}

// From outside a sphere of radiance L sends what a point of intensity pi r^2 L does.
TEST(LightSource, SphereIsAPointOfItsFlux)
{
    NewLight ball = above(LightType::sphere, 2.0f);
    ball.radius = 0.1f;
    EXPECT_NEAR(onFloor(LightSource(ball), {1, 0, 0}),
                kPi * 0.01f * onFloor(LightSource(above(LightType::point, 2.0f)), {1, 0, 0}),
                1e-6f);
}

TEST(LightSource, SunShinesTheSameEverywhere)
{
    NewLight sun;
    sun.type = LightType::sun;
    sun.direction = glm::normalize(glm::vec3(1, -1, 0));
    const LightSource light(sun);
    EXPECT_NEAR(onFloor(light, {0, 0, 0}), std::sqrt(0.5f), 1e-6f);
    EXPECT_NEAR(onFloor(light, {9, 5, 7}), std::sqrt(0.5f), 1e-6f);
}

TEST(LightSource, LooksFindTheLightThatIsThere)
{
    NewLight rectangle = above(LightType::rectangle, 1.5f);
    rectangle.size = {0.8f, 0.4f};
    NewLight disc = above(LightType::disc, 1.5f);
    disc.radius = 0.3f;
    NewLight bulb = above(LightType::point, 1.5f);
    bulb.radius = 0.1f;
    for (const NewLight& light : {rectangle, disc, bulb}) {
        const LightSource source(light);
        const float open = onFloor(source, {0.7f, 0, 0.2f});
        EXPECT_NEAR(byLooks(source, {0.7f, 0, 0.2f}), open, 0.01f * open);
    }
}

TEST(LightSource, AllInstructionSetsAgree)
{
    NewLight lamp = above(LightType::rectangle, 2.0f);
    lamp.size = {1.0f, 0.6f};
    const LightSource light(lamp);
    const float baseline = onFloor(light, {0.3f, 0, 0.2f});
    for (const InstructionSet set : scenes::widerSets())
        EXPECT_NEAR(onFloor(light, {0.3f, 0, 0.2f}, set), baseline, 1e-5f * baseline);
}

TEST(LightProfile, IsLinearBetweenItsAngles)
{
    const LightProfile all{{0.0f, 1.0f, 2.0f}, {0.0f}, {1.0f, 3.0f, 0.0f}};
    EXPECT_NEAR(all.at(0.5f, 1.0f), 2.0f, 1e-6f);
    EXPECT_NEAR(all.at(1.5f, 4.0f), 1.5f, 1e-6f);
    EXPECT_EQ(all.at(2.5f, 0.0f), 0.0f);
    const LightProfile two{{0.0f, kPi}, {0.0f, kPi}, {1.0f, 1.0f, 3.0f, 3.0f}};
    EXPECT_NEAR(two.at(0.3f, 0.5f * kPi), 2.0f, 1e-5f);
    EXPECT_NEAR(two.at(0.3f, 1.5f * kPi), 2.0f, 1e-5f); // and back to where it began
}

} // namespace relamp
