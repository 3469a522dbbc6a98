#include "shading/lit_sides.h"

#include "base/radiometry.shared.h"
#include "scenes/axes.h"
#include "scenes/radiosity.h"
#include "scenes/surfaces.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::kUp;

constexpr glm::vec3 kSidesRoom(2.0f, 1.5f, 3.0f);

LitSides litBy(const scenes::Surfaces& surfaces, const HitLists& hits,
               std::vector<glm::vec3> direct)
{
    const std::vector<uint8_t> noLamps(surfaces.texels.surfels.count(), 0);
    return lightSides(surfaces.texels, hits, surfaces.radiance, std::move(direct), noLamps,
                      glm::vec3(0.0f));
}

/// The same direct irradiance everywhere.
std::vector<glm::vec3> everywhere(const HitLists& hits, float irradiance)
{
    return std::vector<glm::vec3>(hits.sideOfList.size(), glm::vec3(irradiance));
}

/// Whether a surfel is burnt out all over and has a neighbour that is not.
bool isAtTheRim(const scenes::Surfaces& surfaces, uint32_t s)
{
    const auto isPlain = [&](uint32_t n) { return surfaces.radiance.plainArea[n] > 0.0f; };
    const std::span around = surfaces.texels.surfels.neighborsOf(s);
    return !isPlain(s) && std::any_of(around.begin(), around.end(), isPlain);
}

} // namespace

// Walls of 0.4 that see walls of 0.4 and get pi of direct light: albedo is 0.4 / (0.4 + 1).
TEST(LitSides, AlbedoIsWhatTheWallsSendOfWhatTheyGet)
{
    const scenes::Surfaces box(scenes::room(kSidesRoom, 32, scenes::plain(glm::vec3(0.4f))));
    const HitLists hits = scenes::hitListsOf(box, 16);
    for (const glm::vec3 albedo : litBy(box, hits, everywhere(hits, kPi)).albedo)
        EXPECT_NEAR(albedo.g, 0.4f / 1.4f, 1e-3f);
}

// A spot of the floor that gets nine times as much light shows white and sends its share of it. Its
// albedo is that of the floor around.
TEST(LitSides, BurntOutWallSendsMoreThanTheWhiteThatItShows)
{
    const scenes::Surfaces box(scenes::room(kSidesRoom, 64, [](glm::vec3 p, glm::vec3 n) {
        const bool isSpot = n.y > 0.5f && glm::distance(p, glm::vec3(1, 0, 1.5f)) < 0.2f;
        return glm::vec3(isSpot ? 1.0f : 0.4f);
    }));
    const HitLists hits = scenes::hitListsOf(box, 64);
    std::vector<glm::vec3> direct = everywhere(hits, kPi);
    for (const ClippedPatch& patch : box.radiance.clipped)
        if (box.radiance.plainArea[patch.surfel] == 0.0f)
            direct[patch.surfel] = glm::vec3(9.0f * kPi);
    const LitSides sides = litBy(box, hits, direct);
    size_t rim = 0;
    for (const uint32_t s : box.facing(kUp)) {
        if (!isAtTheRim(box, s)) continue;
        EXPECT_NEAR(sides.field.clipped[s].g, 0.4f / 1.4f * 9.4f, 0.2f);
        ++rim;
    }
    EXPECT_GT(rim, 4u);
    EXPECT_NEAR(sides.field.plain[box.at({0.2f, 0, 0.2f}, kUp)].g, 0.4f, 1e-3f);
}

// Warm light on white paint: red is at the top of its range, green and blue are what was there.
TEST(LitSides, OnlyBurntOutChannelsSendMoreThanTheyShow)
{
    const scenes::Surfaces box(scenes::room(kSidesRoom, 64, [](glm::vec3 p, glm::vec3 n) {
        const bool isSpot = n.y > 0.5f && glm::distance(p, glm::vec3(1, 0, 1.5f)) < 0.2f;
        return isSpot ? glm::vec3(1.0f, 0.7f, 0.45f) : glm::vec3(0.4f);
    }));
    const HitLists hits = scenes::hitListsOf(box, 64);
    std::vector<glm::vec3> direct = everywhere(hits, kPi);
    for (const ClippedPatch& patch : box.radiance.clipped)
        if (box.radiance.plainArea[patch.surfel] == 0.0f)
            direct[patch.surfel] = glm::vec3(9.0f * kPi);
    const LitSides sides = litBy(box, hits, direct);
    for (const ClippedPatch& patch : box.radiance.clipped) {
        if (isAtTheRim(box, patch.surfel)) {
            EXPECT_GT(sides.field.clipped[patch.surfel].r, 2.0f);
        }
        EXPECT_EQ(sides.field.clipped[patch.surfel].g, patch.radiance.g);
        EXPECT_EQ(sides.field.clipped[patch.surfel].b, patch.radiance.b);
    }
}

// The shelf shows its lit side upwards; its back sees the floor of 0.5 and the dark alone.
TEST(LitSides, BacksAreLitByWhatIsBehindThem)
{
    const scenes::Panel shelf{{0, 1, 0}, {0, 0, 2}, {2, 0, 0}};
    const scenes::Surfaces two(
        scenes::panels(std::vector<scenes::Panel>{{{0, 0, 0}, {0, 0, 2}, {2, 0, 0}}, shelf}, 32,
                       scenes::plain(glm::vec3(0.5f))));
    const HitLists hits = scenes::hitListsOf(two, 160);
    const LitSides sides = litBy(two, hits, everywhere(hits, 0.0f));
    const uint32_t high = two.at({1, 1, 1}, kUp);
    const scenes::Panel floorFromAbove{{0, 0, 0}, {0, 0, 2}, {2, 0, 0}};
    const float fromFloor = 0.5f * scenes::irradianceFrom(floorFromAbove, {1, 1, 1}, -kUp);
    const auto back = static_cast<size_t>(hits.listOfSide[Side::back(high).index]);
    EXPECT_NEAR(sides.gathered.irradiance[back].g, fromFloor, 0.05f * fromFloor);
    EXPECT_NEAR(sides.field.back[high].g, sides.albedo[high].g * fromFloor / kPi, 0.02f);
}

// Of two rooms one has a lamp. All sides together are asked by scouts, those that somebody names
// one by one.
TEST(LitSides, ScoutsFindALampWhereverItIsSeen)
{
    std::vector<scenes::Panel> walls = scenes::wallsOf({6.0f, 1.5f, 3.0f});
    walls.push_back({{2.9f, 0, 0}, {0, 1.5f, 0}, {0, 0, 3}});
    walls.push_back({{3.1f, 0, 0}, {0, 0, 3}, {0, 1.5f, 0}});
    const scenes::Surfaces two(scenes::panels(walls, 96, scenes::plain(glm::vec3(0.4f))));
    const HitLists hits = scenes::hitListsOf(two, 8);
    const SoughtLamp lamp{scenes::lightOf({{1.0f, 1.4f, 1.3f}, {0.4f, 0, 0}, {0, 0, 0.4f}}, 4)};
    std::vector<uint32_t> names(two.texels.surfels.count());
    std::iota(names.begin(), names.end(), 0u);
    const auto named = directOfLists(two.texels, two.rays, hits, {&lamp, 1}, names).front();
    const LampSight all = directOfLists(two.texels, two.rays, hits, lamp);
    size_t lit = 0;
    for (const uint32_t s : names) {
        EXPECT_EQ(all[s].visible, named[s].visible);
        lit += named[s].visible > 0.0f ? size_t{1} : size_t{0};
        if (two.texels.surfels.position[s].x > 3.05f) {
            EXPECT_EQ(all[s].visible, 0.0f);
        }
    }
    EXPECT_GT(lit, names.size() / 4);
    EXPECT_LT(lit, names.size() / 2);
}

// Of a door's two faces, which take turns among all sides, a lamp on either side lights one.
TEST(LitSides, ScoutsLookFromBothFacesOfADoor)
{
    const glm::vec3 wide(2, 0, 0);
    const glm::vec3 high(0, 2, 0);
    const scenes::Surfaces door(scenes::panels(
        std::vector<scenes::Panel>{{{0, 0, 0}, wide, high}, {{0, 0, -0.004f}, high, wide}}, 64,
        scenes::plain(glm::vec3(0.4f))));
    const HitLists hits = scenes::hitListsOf(door, 8);
    const glm::vec3 aside(0.2f, 0, 0);
    const glm::vec3 up(0, 0.2f, 0);
    for (const auto& panel : {scenes::Panel{{1, 1, 1}, up, aside}, {{1, 1, -1}, aside, up}}) {
        const LampSight seen =
            directOfLists(door.texels, door.rays, hits, {scenes::lightOf(panel, 4)});
        size_t lit = 0;
        for (uint32_t s = 0; s < door.texels.surfels.count(); ++s)
            lit += seen[s].visible > 0.0f ? size_t{1} : size_t{0};
        EXPECT_EQ(lit, door.texels.surfels.count() / 2);
    }
}

// A lamp's light on lists is that of its panel: Lambert's formula, with the shadows of a few rays.
TEST(LitSides, DirectOfListsIsThePanelsFormFactor)
{
    const scenes::Surfaces box(scenes::room(kSidesRoom, 32, scenes::plain(glm::vec3(0.4f))));
    const HitLists hits = scenes::hitListsOf(box, 16);
    const scenes::Panel panel{{0.8f, 1.4f, 1.3f}, {0.4f, 0, 0}, {0, 0, 0.4f}};
    std::vector<ClippedPatch> patches;
    for (int i = 0; i < 64; ++i) {
        const float u = (static_cast<float>(i % 8) + 0.5f) / 8.0f;
        const float v = (static_cast<float>(i / 8) + 0.5f) / 8.0f;
        patches.push_back({panel.at(u, v), -kUp, 0.0025f, 0});
    }
    const LampSight direct =
        directOfLists(box.texels, box.rays, hits, {AreaLight(std::move(patches)), 4});
    float sum = 0.0f;
    float expected = 0.0f;
    for (const uint32_t s : box.facing(kUp)) {
        const float exact = scenes::irradianceFrom(panel, box.texels.surfels.position[s], kUp);
        EXPECT_NEAR(direct[s].open, exact, 0.02f * exact);
        EXPECT_EQ(direct[s].visible, direct[s].open);
        sum += direct[s].open;
        expected += exact;
    }
    EXPECT_NEAR(sum, expected, 0.002f * expected);
}

// Light of another colour that is as bright as that around it stays; what rays err by goes.
TEST(LitSides, AnotherColorIsNoNoise)
{
    const scenes::Surfaces box(scenes::room(kSidesRoom, 32, scenes::plain(glm::vec3(0.4f))));
    const Surfels& surfels = box.texels.surfels;
    std::vector<glm::vec3> light(surfels.count(), glm::vec3(0.3f));
    const size_t blue = surfels.count() / 3;
    const size_t dark = surfels.count() / 2;
    light[blue] = glm::vec3(0.25f, 0.3f, 0.3f + 0.05f * 0.2126f / 0.0722f);
    light[dark] = glm::vec3(0.298f);
    const std::vector<glm::vec3> even =
        withoutNoise(surfels, light, std::vector<float>(surfels.count(), 2e-3f));
    EXPECT_NEAR(even[blue].b, light[blue].b, 0.05f * (light[blue].b - 0.3f));
    EXPECT_GT(even[dark].b, 0.2995f);
}

// A few rays that all met the dark by chance agree, and would be sure of it by themselves.
TEST(LitSides, RaysThatAgreeByChanceAreAsNoisyAsThoseAround)
{
    const scenes::Surfaces box(scenes::room(kSidesRoom, 32, scenes::plain(glm::vec3(0.4f))));
    const Surfels& surfels = box.texels.surfels;
    std::vector<glm::vec3> light(surfels.count(), glm::vec3(0.3f));
    std::vector<float> noise(surfels.count(), 0.1f);
    const size_t dark = surfels.count() / 2;
    light[dark] = glm::vec3(0.2f);
    noise[dark] = 0.0f;
    EXPECT_GT(withoutNoise(surfels, light, noiseAround(surfels, noise))[dark].g, 0.28f);
}

TEST(LitSides, WhatIsSureStaysAsItIsBesideWhatIsNot)
{
    const scenes::Surfaces box(scenes::room(kSidesRoom, 32, scenes::plain(glm::vec3(0.4f))));
    const Surfels& surfels = box.texels.surfels;
    std::vector<glm::vec3> light(surfels.count(), glm::vec3(0.3f));
    std::vector<float> noise(surfels.count(), 1e-3f);
    const size_t bright = surfels.count() / 2;
    light[bright] = glm::vec3(20.0f);
    noise[bright] = 5.0f;
    const std::vector<glm::vec3> even = withoutNoise(surfels, light, noise);
    for (const uint32_t n : surfels.neighborsOf(bright)) {
        if (n == bright) continue;
        EXPECT_NEAR(even[n].g, 0.3f, 1e-3f);
    }
}

TEST(LitSides, IndirectOfAFurnaceIsWhatItsWallsSend)
{
    const scenes::Surfaces box(scenes::room(kSidesRoom, 32, scenes::plain(glm::vec3(0.4f))));
    const HitLists hits = scenes::hitListsOf(box, 16);
    const LitSides sides = litBy(box, hits, everywhere(hits, kPi));
    for (const glm::vec3 irradiance : indirectOfFronts(box.texels.surfels, hits, sides))
        EXPECT_NEAR(irradiance.g, 0.4f * kPi, 2e-3f); // direct light is none of it
}

} // namespace relamp
