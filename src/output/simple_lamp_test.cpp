#include "output/simple_lamp.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

constexpr float kPiHere = 3.14159265f;
constexpr glm::vec3 kDownwards(0.0f, -1.0f, 0.0f);
constexpr glm::vec3 kLampCentre(2.0f, 2.4f, -1.0f);

/// Texels of a surface that faces down, where `isOf(x, z)`, in metres from its centre.
template<class IsOf>
std::vector<LampPoint> ceilingPoints(const IsOf& isOf)
{
    constexpr float kStep = 0.01f;
    std::vector<LampPoint> points;
    for (int i = -100; i <= 100; ++i)
        for (int j = -100; j <= 100; ++j) {
            const float x = kStep * static_cast<float>(i);
            const float z = kStep * static_cast<float>(j);
            if (isOf(x, z))
                points.push_back({kLampCentre + glm::vec3(x, 0.0f, z), kDownwards, kStep * kStep});
        }
    return points;
}

SimpleLamp onlyLamp(const Fixture& fixture, const std::vector<LampPoint>& points)
{
    const std::vector<SimpleLamp> lamps = simpleLamps(fixture, points);
    EXPECT_EQ(lamps.size(), 1u);
    return lamps.front();
}

Fixture ceilingLamp(float area)
{
    return {
        .centre = kLampCentre, .normal = kDownwards, .area = area, .radiance = {8.0f, 4.0f, 2.0f}};
}

} // namespace

// The panel is turned by 30 degrees around the vertical.
TEST(SimpleLamp, APanelIsARectangleOfItsSizeHoweverItLies)
{
    const float c = std::cos(kPiHere / 6.0f);
    const float s = std::sin(kPiHere / 6.0f);
    const auto points = ceilingPoints([&](float x, float z) {
        return std::abs(c * x + s * z) < 0.6f && std::abs(-s * x + c * z) < 0.15f;
    });
    const SimpleLamp lamp = onlyLamp(ceilingLamp(0.36f), points);
    ASSERT_EQ(lamp.shape, LampShape::rectangle);
    EXPECT_NEAR(std::max(lamp.width, lamp.height), 1.2f, 0.03f);
    EXPECT_NEAR(std::min(lamp.width, lamp.height), 0.3f, 0.02f);
    const glm::vec3 along = lamp.axes[lamp.width > lamp.height ? 0 : 1];
    EXPECT_NEAR(std::abs(glm::dot(along, glm::vec3(c, 0.0f, s))), 1.0f, 0.001f);
    EXPECT_NEAR(lamp.position.y, kLampCentre.y - 0.01f, 1e-4f); // just under the panel
    EXPECT_LT(glm::distance(lamp.position, kLampCentre), 0.02f);
}

TEST(SimpleLamp, ARoundOneIsADisc)
{
    const auto points = ceilingPoints([](float x, float z) { return std::hypot(x, z) < 0.25f; });
    const SimpleLamp lamp = onlyLamp(ceilingLamp(0.2f), points);
    ASSERT_EQ(lamp.shape, LampShape::disc);
    EXPECT_NEAR(lamp.radius, 0.25f, 0.01f);
}

TEST(SimpleLamp, ASquareOneIsNone)
{
    const auto points =
        ceilingPoints([](float x, float z) { return std::abs(x) < 0.3f && std::abs(z) < 0.3f; });
    EXPECT_EQ(onlyLamp(ceilingLamp(0.36f), points).shape, LampShape::rectangle);
}

// The low rim of a dome shines as well, and would otherwise draw its outline outwards.
TEST(SimpleLamp, AShallowShadeIsTheOutlineOfItsFaceAndStandsBeforeItsDeepestPoint)
{
    auto points = ceilingPoints([](float x, float z) { return std::hypot(x, z) < 0.25f; });
    for (int i = 0; i < 1000; ++i) {
        const float angle = 0.1f * static_cast<float>(i);
        const glm::vec3 out(std::cos(angle), 0.0f, std::sin(angle));
        points.push_back({kLampCentre + 0.25f * out, out, 1e-5f});
    }
    const SimpleLamp lamp = onlyLamp(ceilingLamp(0.2f), points);
    EXPECT_EQ(lamp.shape, LampShape::disc);
    EXPECT_NEAR(lamp.radius, 0.25f, 0.01f);
    EXPECT_NEAR(lamp.position.y, kLampCentre.y - 0.01f, 1e-4f);
}

// A box of 0.4 x 0.2 x 0.4 m under the ceiling: half of it shines sideways.
TEST(SimpleLamp, ABoxShinesToItsSidesAsMuchAsTheyAreOfIt)
{
    auto points = ceilingPoints(
        [](float x, float z) { return std::abs(x) < 0.195f && std::abs(z) < 0.195f; });
    constexpr float kStep = 0.01f;
    for (int i = -19; i < 20; ++i)
        for (int j = 0; j < 20; ++j)
            for (const float side : {-0.2f, 0.2f}) {
                const float along = kStep * static_cast<float>(i);
                const float up = kStep * static_cast<float>(j);
                points.push_back(
                    {kLampCentre + glm::vec3(side, up, along), {5.0f * side, 0, 0}, kStep * kStep});
                points.push_back(
                    {kLampCentre + glm::vec3(along, up, side), {0, 0, 5.0f * side}, kStep * kStep});
            }
    const std::vector<SimpleLamp> lamps = simpleLamps(ceilingLamp(1.0f), points);
    ASSERT_EQ(lamps.size(), 5u);
    glm::vec3 sent(0.0f);
    for (const SimpleLamp& lamp : lamps) {
        sent += lamp.emission;
        const bool isBelow = lamp.axes[2].y > 0.9f;
        EXPECT_NEAR(lamp.emission.r, isBelow ? 2.6f : 1.33f, 0.1f); // of 8
        EXPECT_NEAR(glm::dot(lamp.position - kLampCentre, -lamp.axes[2]), isBelow ? 0.01f : 0.21f,
                    0.005f);
    }
    EXPECT_NEAR(sent.r, 8.0f, 1e-3f);
}

// A tube that a coarse scan shows as one row of texels of 3 cm: as a line it would be endlessly
// bright.
TEST(SimpleLamp, ARowOfTexelsIsAsWideAsOne)
{
    std::vector<LampPoint> points;
    for (int i = 0; i < 8; ++i)
        points.push_back(
            {kLampCentre + glm::vec3(0.03f * static_cast<float>(i), 0, 0), kDownwards, 9e-4f});
    const SimpleLamp row = onlyLamp(ceilingLamp(0.01f), points);
    EXPECT_NEAR(row.width, 0.24f, 0.01f);
    EXPECT_NEAR(row.height, 0.03f, 0.005f);
    points.resize(1);
    EXPECT_GE(onlyLamp(ceilingLamp(0.001f), points).area(), 9e-4f);
}

TEST(SimpleLamp, AGlobeIsASphereAroundIt)
{
    std::vector<LampPoint> points;
    for (int i = 0; i < 4000; ++i) { // along a spiral
        const float y = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / 4000.0f;
        const float angle = 2.3999632f * static_cast<float>(i);
        const float r = std::sqrt(1.0f - y * y);
        const glm::vec3 out(r * std::cos(angle), y, r * std::sin(angle));
        points.push_back({kLampCentre + 0.15f * out, out, 7e-5f});
    }
    Fixture globe = ceilingLamp(0.28f);
    globe.normal = glm::vec3(0.0f);
    const SimpleLamp lamp = onlyLamp(globe, points);
    ASSERT_EQ(lamp.shape, LampShape::sphere);
    EXPECT_NEAR(lamp.radius, 0.16f, 1e-3f);
    EXPECT_EQ(lamp.position, kLampCentre);
}

// Flux is pi L A: by a factor of pi or of the sphere's four it would be another lamp.
TEST(SimpleLamp, WhateverItsShapeItSendsWhatTheFixtureSends)
{
    const auto points = ceilingPoints([](float x, float z) { return std::hypot(x, z) < 0.25f; });
    Fixture fixture = ceilingLamp(0.5f);
    const SimpleLamp disc = onlyLamp(fixture, points);
    EXPECT_EQ(disc.emission, glm::vec3(4.0f, 2.0f, 1.0f));
    fixture.normal = glm::vec3(0.0f);
    const SimpleLamp ball = onlyLamp(fixture, {});
    EXPECT_EQ(ball.emission, glm::vec3(4.0f, 2.0f, 1.0f));
    EXPECT_NEAR(ball.area(), fixture.area, 1e-5f);
    EXPECT_NEAR(onlyLamp(ceilingLamp(0.5f), {}).area(), fixture.area, 1e-5f);
    // A ball of radiance L seen from far is I = L pi r^2.
    const SimpleLamp bulb = simpleLamp({.intensity = glm::vec3(2.0f), .radius = 0.1f});
    EXPECT_NEAR(bulb.emission.x / bulb.area() * kPiHere * 0.1f * 0.1f, 2.0f, 1e-5f);
}

TEST(SimpleLamp, ASquareStandsUprightAndShinesIntoTheRoom)
{
    const SimpleLamp lamp = squareLamp({0, 1, 0}, {0, 0, -1}, 4.0f, glm::vec3(0.5f));
    EXPECT_EQ(lamp.width, 2.0f);
    EXPECT_EQ(lamp.axes[2], glm::vec3(0, 0, 1)); // it shines along -z of its own
    EXPECT_EQ(lamp.axes[1], glm::vec3(0, 1, 0));
    EXPECT_EQ(glm::cross(lamp.axes[0], lamp.axes[1]), lamp.axes[2]);
    EXPECT_EQ(lamp.emission, glm::vec3(2.0f));
}

} // namespace relamp
