#include "base/half.h"
#include "relamp/delight.h"
#include "scenes/lit_room.h"
#include "scenes/surfaces.h"

#include <algorithm>
#include <optional>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::LitBox;
using scenes::LitRoom;
using scenes::Paint;
using scenes::ShiningPanel;

constexpr glm::vec3 kScreenCentre{0.0f, 1.3f, 2.5f}; // on the wall x = 0
constexpr glm::vec3 kScreen{0.7f, 0.8f, 0.75f};      // radiance
constexpr float kScreenArea = 0.6f;                  // m^2

ShiningPanel ceilingPanel()
{
    return {{LitRoom::kLampCentre - glm::vec3(0.4f, 0.0f, 0.3f), {0.8f, 0, 0}, {0, 0, 0.6f}},
            glm::vec3(5.0f)};
}

ShiningPanel screen()
{
    return {{kScreenCentre - glm::vec3(0.0f, 0.3f, 0.5f), {0, 0.6f, 0}, {0, 0, 1.0f}}, kScreen};
}

Scan photoOf(const LitBox& box)
{
    return scenes::room(LitRoom::kSize, 96,
                        [&](glm::vec3 p, glm::vec3 n) { return box.photo(p, n); });
}

/// A dim room whose white is far above its walls: in it a sheet of paper, or a screen in its place.
Scan roomWithScreen(float share = 1.0f)
{
    ShiningPanel dimmed = screen();
    dimmed.radiance *= share;
    return photoOf(LitBox(LitRoom::kSize, {ceilingPanel(), dimmed}, LitRoom::albedo));
}

Decomposition solved(const Scan& scan, const std::optional<Lights>& lights = {},
                     std::vector<FixtureMap> fixtures = {})
{
    Progress progress;
    DelightOptions options;
    options.gather.quality = Quality::draft;
    options.lights = lights;
    options.fixtures = std::move(fixtures);
    return delight(scenes::copyOf(scan), options, progress);
}

PageLayers layersOf(const Decomposition& result)
{
    Progress progress;
    return result.layers(0, progress);
}

/// The fixture on the wall; null where there is none.
const Fixture* screenOf(const Lights& lights)
{
    for (const Fixture& fixture : lights.fixtures)
        if (glm::distance(fixture.centre, kScreenCentre) < 0.1f) return &fixture;
    return nullptr;
}

size_t texelsOf(const FixtureMap& map, int id)
{
    return static_cast<size_t>(std::count(map.id.begin(), map.id.end(), id));
}

} // namespace

// White paper in its place would show less than 0.15.
TEST(Glowing, ScreenIsALampAndAsBrightAsItShows)
{
    const Decomposition result = solved(roomWithScreen());
    ASSERT_EQ(result.lights().fixtures.size(), 2u);
    const Fixture* found = screenOf(result.lights());
    ASSERT_NE(found, nullptr);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found->radiance[c], kScreen[c], 0.02f);
    EXPECT_NEAR(found->area, kScreenArea, 0.06f);
    EXPECT_GT(found->normal.x, 0.99f);
    EXPECT_TRUE(found->determined);
    const PageLayers layers = layersOf(result);
    const FixtureMap map = result.fixtures(0);
    const size_t texels = texelsOf(map, found->id);
    ASSERT_GT(texels, 100u);
    size_t emitting = 0;
    for (size_t pixel = 0; pixel < map.id.size(); ++pixel)
        if (map.id[pixel] == found->id && layers.emission[3 * pixel] != 0) ++emitting;
    EXPECT_EQ(emitting, texels);
}

TEST(Glowing, ScreenThatAPersonCallsNoLightIsNone)
{
    Progress progress;
    DelightOptions options;
    options.gather.quality = Quality::draft;
    options.gather.notLights = {kScreenCentre, {2.0f, 0.0f, 2.5f}};
    const Decomposition result = delight(roomWithScreen(), options, progress);
    EXPECT_EQ(screenOf(result.lights()), nullptr);
    EXPECT_THAT(result.warnings(), testing::Contains(testing::HasSubstr("passed over")).Times(1));
    EXPECT_THAT(result.warnings(),
                testing::Contains(testing::HasSubstr("nothing is burnt out near 2, 0, 2.5")));
}

// It shows too little to be sure, as a curtain before a window does where a camera mapped tones.
TEST(Glowing, DimScreenIsALampWhereAPersonSaysSo)
{
    constexpr float kDim = 0.55f; // of the other
    const Scan scan = roomWithScreen(kDim);
    EXPECT_EQ(screenOf(solved(scan).lights()), nullptr);
    Progress progress;
    DelightOptions options;
    options.gather.lights = {kScreenCentre};
    const Decomposition result = delight(scenes::copyOf(scan), options, progress);
    const Fixture* found = screenOf(result.lights());
    ASSERT_NE(found, nullptr);
    EXPECT_NEAR(found->area, kScreenArea, 0.06f);
    EXPECT_NEAR(found->radiance.g, kDim * kScreen.g, 0.1f * kDim * kScreen.g);
    const std::optional<Lights> given = result.lights();
    const Decomposition again = solved(scan, given, {result.fixtures(0)});
    ASSERT_NE(screenOf(again.lights()), nullptr);
    EXPECT_NEAR(screenOf(again.lights())->area, found->area, 1e-4f);
}

TEST(Glowing, PlaceThatAPersonCallsNoLightIsNoneThoughItWasCalledOneAsWell)
{
    Progress progress;
    DelightOptions options;
    options.gather.quality = Quality::draft;
    options.gather.lights = {kScreenCentre};
    options.gather.notLights = {kScreenCentre};
    EXPECT_EQ(screenOf(delight(roomWithScreen(0.55f), options, progress).lights()), nullptr);
}

TEST(Glowing, GivenBackItIsTheSameLamp)
{
    const Scan scan = roomWithScreen();
    const Decomposition first = solved(scan);
    const Decomposition second = solved(scan, first.lights(), {first.fixtures(0)});
    EXPECT_EQ(second.fixtures(0).id, first.fixtures(0).id);
    const Fixture* again = screenOf(second.lights());
    ASSERT_NE(again, nullptr);
    EXPECT_NEAR(again->area, screenOf(first.lights())->area, 1e-4f);
    EXPECT_EQ(layersOf(second).emission, layersOf(first).emission);
}

TEST(Glowing, WhitePaperIsNone)
{
    const Decomposition result =
        solved(photoOf(LitBox(LitRoom::kSize, {ceilingPanel()}, LitRoom::albedo)));
    EXPECT_EQ(result.lights().fixtures.size(), 1u);
    EXPECT_EQ(screenOf(result.lights()), nullptr);
}

// The sun came in through a window that was not scanned, and is no lamp.
TEST(Glowing, PatchOfSunOnTheFloorIsNone)
{
    const LitBox box(LitRoom::kSize, {ceilingPanel()}, LitRoom::albedo);
    const Decomposition result =
        solved(scenes::room(LitRoom::kSize, 96, [&](glm::vec3 p, glm::vec3 n) {
            const bool isSunlit = n.y > 0.5f && glm::distance(p, {3.0f, 0.0f, 3.5f}) < 0.4f;
            return isSunlit ? glm::vec3(0.85f) : box.photo(p, n);
        }));
    for (const Fixture& fixture : result.lights().fixtures) EXPECT_LT(fixture.normal.y, 0.5f);
    EXPECT_EQ(texelsOf(result.fixtures(0), FixtureMap::kWall), 0u);
}

} // namespace relamp
