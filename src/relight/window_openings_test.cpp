#include "relight/window_openings.h"

#include "scenes/scenes.h"

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using Patches = std::vector<ClippedPatch>;

/// Half a square metre in the middle of something.
Patches fixtureAt(glm::vec3 position, glm::vec3 normal, float area = 0.5f)
{
    return Patches(4, {position, normal, 0.25f * area, 0});
}

} // namespace

TEST(WindowOpenings, AreUprightAndHaveNothingBehind)
{
    const Scan room = scenes::room({3, 2.5f, 4}, 16, scenes::plain(glm::vec3(0.5f)));
    const RayScene scene(room);
    const std::vector<Patches> fixtures{
        fixtureAt({0, 1.2f, 2}, {1, 0, 0}),        // in a wall
        fixtureAt({1.5f, 2.5f, 2}, {0, -1, 0}),    // in the ceiling
        fixtureAt({1.5f, 1.2f, 2}, {1, 0, 0}),     // a screen in the room
        fixtureAt({0, 1.2f, 2}, {1, 0, 0}, 0.02f), // a lamp on a wall
        {}};
    EXPECT_EQ(likelyWindowOpenings(scene, fixtures), (std::vector<uint8_t>{1, 0, 0, 0, 0}));
}

TEST(WindowOpenings, OpenToSunAndSkyUnlessSomebodySaysWhich)
{
    const std::vector<uint8_t> isOpening{1, 0, 1};
    Relighting lighting;
    const Lights captured{.fixtures = {{.id = 4}, {.id = 0}, {.id = 9}}};
    lighting.fixtures = darkened(captured).fixtures;
    lighting.fixtures[2].fixture.radiance = glm::vec3(1.0f); // is on
    const auto areOpen = [&] {
        std::vector<bool> open;
        for (const LitFixture& lit : withWindowOpenings(lighting, captured, isOpening).fixtures)
            open.push_back(lit.isWindow);
        return open;
    };
    EXPECT_EQ(areOpen(), (std::vector<bool>{false, false, false})); // nothing shines in
    lighting.sky.radiance = glm::vec3(1.0f);
    EXPECT_EQ(areOpen(), (std::vector<bool>{true, false, false}));
    lighting.sky.radiance = glm::vec3(0.0f);
    lighting.lights.push_back({.type = LightType::sun, .emission = glm::vec3(1.0f)});
    EXPECT_EQ(areOpen(), (std::vector<bool>{true, false, false}));
    std::swap(lighting.fixtures[0], lighting.fixtures[1]); // they are known by their numbers
    EXPECT_EQ(areOpen(), (std::vector<bool>{false, true, false}));
    std::swap(lighting.fixtures[0], lighting.fixtures[1]);
    lighting.fixtures[1].isWindow = true;
    EXPECT_EQ(areOpen(), (std::vector<bool>{false, true, false}));
}

} // namespace relamp
