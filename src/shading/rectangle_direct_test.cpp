#include "shading/rectangle_direct.h"

#include "base/radiometry.shared.h"
#include "scenes/axes.h"
#include "scenes/form_factors.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::kDown;
using scenes::kUp;

/// x to `size.x` and z to `size.y` at a height, shining down.
ShiningRectangle ceiling(glm::vec2 size, float height)
{
    return {{glm::vec3(0, height, 0), glm::vec3(size.x, height, 0),
             glm::vec3(size.x, height, size.y), glm::vec3(0, height, size.y)},
            kDown};
}

} // namespace

// Howell's B-4 in the corner of a floor, and the mean over it and over a wall.
TEST(RectangleDirect, IsTheTextbooksFactor)
{
    const ShiningRectangle lamp = ceiling({4.0f, 5.0f}, 2.5f);
    const double a = 4.0 / 2.5;
    const double b = 5.0 / 2.5;
    const double x = std::sqrt(1.0 + a * a);
    const double y = std::sqrt(1.0 + b * b);
    const double corner = 0.5 * (a / x * std::atan(b / x) + b / y * std::atan(a / y));
    EXPECT_NEAR(static_cast<double>(irradianceOf(lamp, glm::vec3(0.0f), kUp)), corner, 1e-5);
    double onFloor = 0.0;
    double onWall = 0.0; // x = 0
    constexpr int kAcross = 200;
    for (int j = 0; j < kAcross; ++j)
        for (int i = 0; i < kAcross; ++i) {
            const float u = (static_cast<float>(i) + 0.5f) / kAcross;
            const float v = (static_cast<float>(j) + 0.5f) / kAcross;
            onFloor +=
                static_cast<double>(irradianceOf(lamp, {4.0f * u, 0.0f, 5.0f * v}, kUp) / kPi);
            onWall += static_cast<double>(
                irradianceOf(lamp, {0.0f, 2.5f * u, 5.0f * v}, {1.0f, 0.0f, 0.0f}) / kPi);
        }
    EXPECT_NEAR(onFloor / (kAcross * kAcross), scenes::opposite(4.0, 5.0, 2.5), 1e-4);
    EXPECT_NEAR(onWall / (kAcross * kAcross), scenes::adjacent(5.0, 2.5, 4.0), 1e-4);
}

// Half a plane that stands on a horizon fills a quarter of what faces along it.
TEST(RectangleDirect, EndsAtTheHorizonAndAtItsBack)
{
    const ShiningRectangle wide = ceiling({2000.0f, 2000.0f}, 1.0f);
    const glm::vec3 under(1000.0f, 0.0f, 1000.0f);
    EXPECT_NEAR(irradianceOf(wide, under, kUp), kPi, 0.005f);
    EXPECT_NEAR(irradianceOf(wide, under, {1.0f, 0.0f, 0.0f}), 0.5f * kPi, 0.005f);
    EXPECT_EQ(irradianceOf(wide, under, kDown), 0.0f);
    EXPECT_EQ(irradianceOf(wide, under + 2.0f * kUp, kDown), 0.0f);
    EXPECT_EQ(irradianceOf(wide, under + kUp, {1.0f, 0.0f, 0.0f}), 0.0f);
}

// From afar it is A cos cos' / d^2, tilted as it may be.
TEST(RectangleDirect, IsAPointFromAfar)
{
    const ShiningRectangle small = ceiling({0.02f, 0.01f}, 3.0f);
    const glm::vec3 way(0.01f - 1.0f, 3.0f, 0.005f + 2.0f);
    const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, 0.8f, -0.1f));
    const float squared = glm::dot(way, way);
    const float exact = 2e-4f * glm::dot(way, normal) * way.y / (squared * squared);
    EXPECT_NEAR(irradianceOf(small, {1.0f, 0.0f, -2.0f}, normal), exact, 1e-3f * exact);
}

} // namespace relamp
