#include "shading/openings.h"

#include "scenes/axes.h"
#include "scenes/surfaces.h"
#include "shading/gather.h"

#include <numeric>
#include <vector>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

constexpr glm::vec3 kOpenRoom(3.0f, 2.0f, 4.0f);
enum Wall { kMissingCeiling = 1, kMissingSide }; // the second: x = 0

scenes::Surfaces withoutWall(Wall wall)
{
    std::vector<scenes::Panel> walls = scenes::wallsOf(kOpenRoom);
    walls.erase(walls.begin() + wall);
    return scenes::Surfaces(scenes::panels(walls, 32, scenes::plain(glm::vec3(0.4f))));
}

/// Irradiance on a list by each part of what lies outside, at radiance 1.
std::vector<float> missedOn(const HitLists& hits, uint32_t list)
{
    std::vector<float> missed(hits.shareOfPart.size(), 0.0f);
    for (const auto [part, irradiance] : missedOf(hits, list)) missed[part] = irradiance;
    return missed;
}

} // namespace

TEST(Openings, ClosedRoomHasNone)
{
    const scenes::Surfaces box(scenes::room(kOpenRoom, 32, scenes::plain(glm::vec3(0.4f))));
    const HitLists hits = scenes::hitListsOf(box, 32);
    EXPECT_EQ(hits.shareOfPart.size(), 1u);
    EXPECT_THAT(hits.squares, testing::IsEmpty());
}

// One radiance for everything outside, however many parts that has: as if it had none.
TEST(Openings, EvenOutsideGivesWhatOnePartGives)
{
    const glm::vec3 outside(0.7f, 0.5f, 0.2f);
    for (const Wall wall : {kMissingCeiling, kMissingSide}) {
        const scenes::Surfaces box(withoutWall(wall));
        const HitLists hits = scenes::hitListsOf(box, 32);
        const Gathered dark = gather(hits, fieldOf(box.radiance));
        RadianceField field = fieldOf(box.radiance);
        field.outside = outsideOf(std::vector(hits.shareOfPart.size(), outside), hits.shareOfPart);
        const Gathered lit = gather(hits, field);
        for (size_t i = 0; i < lit.irradiance.size(); ++i)
            ASSERT_LT(
                glm::distance(lit.irradiance[i], dark.irradiance[i] + dark.missed[i] * outside),
                1e-5f);
        EXPECT_LT(glm::distance(field.outside.even(), outside), 1e-6f);
    }
}

TEST(Openings, CeilingThatIsMissingIsOnePartUnderSquaresThatFaceDown)
{
    const scenes::Surfaces box(withoutWall(kMissingCeiling));
    const HitLists hits = scenes::hitListsOf(box, 32);
    ASSERT_EQ(hits.shareOfPart.size(), 2u);
    float area = 0.0f;
    for (const Candidate& square : hits.squares) {
        EXPECT_EQ(square.normal, scenes::kDown);
        EXPECT_GT(square.centre.y, kOpenRoom.y);
        EXPECT_LT(square.centre.y, kOpenRoom.y + 0.3f);
        area += square.area;
    }
    EXPECT_NEAR(area, kOpenRoom.x * kOpenRoom.z, 0.3f * kOpenRoom.x * kOpenRoom.z);
}

// Also what leaves steeply, along the wall that the hole is in: a window lights the floor below it.
TEST(Openings, AllLightThatComesThroughAHoleIsOfItsParts)
{
    for (const Wall wall : {kMissingCeiling, kMissingSide}) {
        const scenes::Surfaces box(withoutWall(wall));
        const HitLists hits = scenes::hitListsOf(box, 32);
        const auto& shares = hits.shareOfPart;
        EXPECT_LT(shares[0], 0.002f * std::accumulate(shares.begin(), shares.end(), 0.0f));
    }
}

// Every line out through a hole begins at a surface that is there: so many of their rays leave.
TEST(Openings, HolesAreAsLargeAsTheyAreAndWhereTheyAre)
{
    const scenes::Surfaces top(withoutWall(kMissingCeiling));
    const HitLists hits = scenes::hitListsOf(top, 32);
    ASSERT_EQ(hits.holes.size(), 1u);
    const float ceiling = kOpenRoom.x * kOpenRoom.z;
    EXPECT_NEAR(hits.holes[0].area, ceiling, 0.1f * ceiling);
    EXPECT_EQ(hits.holes[0].normal, scenes::kDown);
    EXPECT_NEAR(hits.holes[0].centre.x, 0.5f * kOpenRoom.x, 0.1f);
    EXPECT_NEAR(hits.holes[0].centre.z, 0.5f * kOpenRoom.z, 0.1f);
    EXPECT_EQ(hits.holes[0].parts, 1u);

    const scenes::Surfaces side(withoutWall(kMissingSide));
    const HitLists ofSide = scenes::hitListsOf(side, 32);
    ASSERT_EQ(ofSide.holes.size(), 1u);
    EXPECT_EQ(ofSide.holes[0].parts, 2u);
    EXPECT_NEAR(ofSide.holes[0].normal.y, 0.0f, 1e-6f);
}

TEST(Openings, AreTheSameHoweverTheRoomStands)
{
    std::vector<scenes::Panel> walls = scenes::wallsOf(kOpenRoom);
    walls.erase(walls.begin() + kMissingSide);
    const WallFrame turned(0.6);
    for (scenes::Panel& wall : walls)
        wall = {turned.fromScan(wall.corner), turned.fromScan(wall.alongU),
                turned.fromScan(wall.alongV)};
    const scenes::Surfaces room(scenes::panels(walls, 32, scenes::plain(glm::vec3(0.4f))));
    const HitLists hits = scenes::hitListsOf(room, 32);
    ASSERT_EQ(hits.holes.size(), 1u);
    const float side = kOpenRoom.y * kOpenRoom.z;
    EXPECT_NEAR(hits.holes[0].area, side, 0.1f * side);
    EXPECT_GT(glm::dot(hits.holes[0].normal, turned.fromScan({1, 0, 0})), 0.999f); // into the room
    EXPECT_LT(hits.shareOfPart[0], 0.002f * side);
}

// What a floor sees through a window is sky, what a ceiling sees is ground.
TEST(Openings, WindowShowsTheFloorTheSkyAndTheCeilingTheGround)
{
    const scenes::Surfaces box(withoutWall(kMissingSide));
    const HitLists hits = scenes::hitListsOf(box, 32);
    ASSERT_EQ(hits.shareOfPart.size(), 3u);
    float sky = 0.0f;
    for (const uint32_t s : box.facing(scenes::kUp)) {
        sky += missedOn(hits, s)[1];
        EXPECT_EQ(missedOn(hits, s)[2], 0.0f);
    }
    float ground = 0.0f;
    for (const uint32_t s : box.facing(scenes::kDown)) {
        ground += missedOn(hits, s)[2];
        EXPECT_EQ(missedOn(hits, s)[1], 0.0f);
    }
    EXPECT_GT(sky, 1.0f);
    EXPECT_NEAR(ground, sky, 0.05f * sky);         // a box is the same upside down
    EXPECT_THAT(hits.squares, testing::IsEmpty()); // it is far, and no lamp
}

} // namespace relamp
