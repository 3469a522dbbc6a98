#include "fit/lamps.h"

#include "fit/pairs.h"
#include "scenes/lit_room.h"
#include "scenes/many_lamps.h"
#include "scenes/surfaces.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::LitRoom;

FoundLamps lampsOf(const scenes::Surfaces& room, const GatherOptions& options)
{
    Progress progress;
    return findLamps(room.texels, room.rays, scenes::hitListsOf(room, 64), room.radiance, options,
                     roomsOf(room.texels.surfels, room.rays), progress);
}

/// What is found in the room with the panel and the burnt-out sheet.
FoundLamps found(const GatherOptions& options = {})
{
    return lampsOf(scenes::Surfaces(LitRoom().scan), options);
}

glm::vec3 powerOf(const FoundLamps& lamps, size_t lamp)
{
    float area = 0.0f;
    for (const ClippedPatch& patch : lamps.lamps[lamp].patches) area += patch.area;
    return area * lamps.powers.lamps[lamp];
}

float distanceTo(const FoundLamp& lamp, glm::vec3 place)
{
    float least = 1e9f;
    for (const ClippedPatch& patch : lamp.patches)
        least = std::min(least, glm::distance(patch.position, place));
    return least;
}

} // namespace

// The room is one scan with two white patches of about the same size; only one lights the others.
TEST(Lamps, PanelIsFoundWithItsPowerAndTheBurntOutSheetIsNot)
{
    const FoundLamps lamps = found();
    ASSERT_EQ(lamps.lamps.size(), 1u);
    EXPECT_LT(distanceTo(lamps.lamps[0], LitRoom::kLampCentre), 0.1f);
    const glm::vec3 ratio = powerOf(lamps, 0) / (LitRoom::kLampArea * LitRoom::kLampRadiance);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(ratio[c], 1.0f, 0.1f) << "channel " << c;
    EXPECT_GT(lamps.lamps[0].logError.g, 0.0f);
    EXPECT_LT(lamps.lamps[0].logError.g, 0.2f);
    EXPECT_THAT(lamps.warnings, testing::IsEmpty());
}

TEST(Lamps, PlaceThatAPersonCallsALightStays)
{
    const FoundLamps lamps = found({.lights = {LitRoom::kSheetCentre}});
    ASSERT_EQ(lamps.lamps.size(), 2u);
    EXPECT_LT(distanceTo(lamps.lamps[0], LitRoom::kLampCentre), 0.1f); // the stronger is first
    EXPECT_LT(distanceTo(lamps.lamps[1], LitRoom::kSheetCentre), 0.1f);
}

TEST(Lamps, PlaceThatAPersonCallsNoLightIsNone)
{
    const FoundLamps lamps =
        found({.lights = {LitRoom::kSheetCentre}, .notLights = {LitRoom::kLampCentre}});
    ASSERT_EQ(lamps.lamps.size(), 1u); // the other stays
    EXPECT_LT(distanceTo(lamps.lamps[0], LitRoom::kSheetCentre), 0.1f);
}

TEST(Lamps, PlaceWithoutAnythingBurntOutIsNamed)
{
    EXPECT_THAT(found({.notLights = {{2.0f, 0.0f, 2.5f}}}).nothingNear,
                testing::ElementsAre(glm::vec3(2.0f, 0.0f, 2.5f)));
}

TEST(Lamps, ResponseThatAPersonKnowsIsTakenAndNotSought)
{
    constexpr Response kKnown{{1.1f, 1.05f, 1.0f, 0.95f, 0.9f}};
    EXPECT_EQ(found({.response = kKnown}).camera.response, kKnown);
    EXPECT_TRUE(found({.response = Response{}}).camera.response.isStraight());
}

TEST(Lamps, TexturesOfFloatsAreOfNoCamera)
{
    Scan scan = LitRoom().scan;
    for (Page& page : scan.pages) page.image.clipsAtWhite = false;
    const FoundLamps lamps =
        lampsOf(scenes::Surfaces(std::move(scan)), {.response = Response{{2, 2, 2, 2, 2}}});
    EXPECT_TRUE(lamps.camera.response.isStraight());
    EXPECT_THAT(lamps.warnings, testing::Contains(testing::HasSubstr("a texture is of floats")));
}

TEST(Lamps, RoomWithoutAnythingBurntOutHasNone)
{
    const scenes::Surfaces room(scenes::room({2, 2, 2}, 32, scenes::plain(glm::vec3(0.4f))));
    EXPECT_THAT(lampsOf(room, {}).lamps, testing::IsEmpty());
}

// A panel on the roof, where no surface that it lights is scanned.
TEST(Lamps, LampThatLightsNothingSeenIsNotDetermined)
{
    const LitRoom room;
    std::vector<scenes::Panel> walls = scenes::wallsOf(LitRoom::kSize);
    walls.push_back({{1, 3, 1}, {0, 0, 0.5f}, {0.5f, 0, 0}});
    const FoundLamps lamps =
        lampsOf(scenes::Surfaces(scenes::panels(walls, 96,
                                                [&](glm::vec3 place, glm::vec3 normal) {
                                                    return place.y > 2.9f
                                                               ? glm::vec3(1.0f)
                                                               : room.box.photo(place, normal);
                                                })),
                {.lights = {{1.25f, 3.0f, 1.25f}}});
    ASSERT_EQ(lamps.lamps.size(), 2u);
    EXPECT_TRUE(lamps.lamps[0].isDetermined);
    EXPECT_FALSE(lamps.lamps[1].isDetermined);
    EXPECT_LT(distanceTo(lamps.lamps[1], {1.25f, 3.0f, 1.25f}), 0.3f);
    EXPECT_NEAR(lamps.powers.lamps[1].g, 1.0f, 0.1f);
    EXPECT_THAT(lamps.warnings, testing::ElementsAre(testing::HasSubstr(
                                    "how bright the light at 1.25, 3.00, 1.25 is")));
}

// A house has as many places to look at a room as a room has, and no lamp of one lights another.
TEST(Lamps, EveryRoomOfAHouseHasItsOwn)
{
    constexpr int kRooms = 4;
    constexpr float kApart = LitRoom::kSize.x + 0.2f;
    const LitRoom room;
    ASSERT_EQ(room.scan.pages.size(), 1u);
    const FoundLamps lamps =
        lampsOf(scenes::Surfaces(scenes::rowOf(room.scan, kRooms, kApart)), {});
    ASSERT_EQ(lamps.lamps.size(), size_t{kRooms});
    for (int k = 0; k < kRooms; ++k) {
        const glm::vec3 centre =
            LitRoom::kLampCentre + glm::vec3(kApart * static_cast<float>(k), 0.0f, 0.0f);
        size_t here = lamps.lamps.size();
        for (size_t l = 0; l < lamps.lamps.size(); ++l)
            if (distanceTo(lamps.lamps[l], centre) < 0.1f) here = l;
        ASSERT_LT(here, lamps.lamps.size()) << "room " << k;
        EXPECT_NEAR(powerOf(lamps, here).g / (LitRoom::kLampArea * LitRoom::kLampRadiance.g), 1.0f,
                    0.1f);
    }
}

TEST(Lamps, ThreeHundredCeilingPanelsAreFoundInGroups)
{
    const scenes::ManyLamps hall(20, 15);
    const FoundLamps lamps = lampsOf(scenes::Surfaces(hall.scan), {});
    EXPECT_LE(lamps.lamps.size(), 32u);
    size_t found = 0;
    for (size_t l = 0; l < lamps.lamps.size(); ++l) {
        const auto singles = singlesOf(lamps.lamps[l]);
        for (const auto& patches : singles) {
            const Candidate one = candidateOf({patches.begin(), patches.end()});
            EXPECT_TRUE(hall.box.isLamp(one.centre, {0, -1, 0}));
        }
        found += singles.size();
        const glm::vec3 ratio =
            powerOf(lamps, l) / (static_cast<float>(singles.size()) * hall.lampPower());
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(ratio[c], 1.0f, 0.15f) << "channel " << c;
    }
    EXPECT_EQ(found, 300u);
    EXPECT_THAT(lamps.warnings, testing::IsEmpty());
}

// The photo was exposed for what is outdoors: the sky is 1.6 times white.
TEST(Lamps, WindowThatIsHardlyBrighterThanWhiteIsFound)
{
    const scenes::ShiningPanel window{{{0.5f, 0.6f, 0.0f}, {3, 0, 0}, {0, 1.5f, 0}},
                                      glm::vec3(1.4f, 1.6f, 2.2f)};
    const scenes::LitBox box(LitRoom::kSize, {window}, LitRoom::albedo);
    const FoundLamps lamps =
        lampsOf(scenes::Surfaces(scenes::room(
                    LitRoom::kSize, 96, [&](glm::vec3 p, glm::vec3 n) { return box.photo(p, n); })),
                {});
    ASSERT_EQ(lamps.lamps.size(), 1u);
    const glm::vec3 ratio = powerOf(lamps, 0) / (4.5f * window.radiance);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(ratio[c], 1.0f, 0.1f) << "channel " << c;
}

// The same room without its ceiling, and so without its lamp.
TEST(Lamps, LampInACeilingThatWasNotScannedIsFound)
{
    const LitRoom room;
    std::vector<scenes::Panel> walls = scenes::wallsOf(LitRoom::kSize);
    walls.erase(walls.begin() + 1);
    const FoundLamps lamps =
        lampsOf(scenes::Surfaces(scenes::panels(
                    walls, 96, [&](glm::vec3 p, glm::vec3 n) { return room.box.photo(p, n); })),
                {});
    ASSERT_FALSE(lamps.lamps.empty());
    glm::vec3 power(0.0f);
    glm::vec3 centre(0.0f);
    for (size_t l = 0; l < lamps.lamps.size(); ++l) {
        power += powerOf(lamps, l);
        centre += powerOf(lamps, l).g * candidateOf(lamps.lamps[l].patches).centre;
    }
    centre /= power.g;
    EXPECT_LT(glm::distance(centre, LitRoom::kLampCentre), 0.4f); // it is sought in squares of 0.5
    const glm::vec3 ratio = power / (LitRoom::kLampArea * LitRoom::kLampRadiance);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(ratio[c], 1.0f, 0.3f) << "channel " << c;
}

} // namespace relamp
