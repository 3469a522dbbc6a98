#include "shading/rooms.h"

#include "scenes/surfaces.h"

#include <array>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::Panel;
using testing::ElementsAre;

constexpr glm::vec3 kTwoRooms{7.0f, 2.5f, 4.0f};

/// A wall across them, which both sides see, from x = 3.9 to x = 4.1, with a gap from z = 0 on.
void addWall(float gap, std::vector<Panel>& walls)
{
    const float length = kTwoRooms.z - gap;
    walls.push_back({{3.9f, 0, gap}, {0, 0, length}, {0, kTwoRooms.y, 0}});
    walls.push_back({{4.1f, 0, gap}, {0, kTwoRooms.y, 0}, {0, 0, length}});
    walls.push_back({{3.9f, 0, gap}, {0, kTwoRooms.y, 0}, {0.2f, 0, 0}});
}

scenes::Surfaces roomsWith(float gap)
{
    std::vector<Panel> walls = scenes::wallsOf(kTwoRooms);
    addWall(gap, walls);
    return scenes::Surfaces(scenes::panels(walls, 96, scenes::plain(glm::vec3(0.5f))));
}

/// Which share of surfels on either side of the wall is in the second room.
std::array<double, 2> sharesOfSecond(const scenes::Surfaces& surfaces)
{
    const HitLists hits = scenes::hitListsOf(surfaces, 16);
    const std::vector<uint8_t> room = roomsOfSurfels(surfaces.texels, hits, 8);
    std::array<double, 2> all{};
    std::array<double, 2> second{};
    for (size_t s = 0; s < room.size(); ++s) {
        const size_t side = surfaces.texels.surfels.position[s].x < 4.0f ? 0 : 1;
        all[side] += 1.0;
        second[side] += room[s] == 1 ? 1.0 : 0.0;
    }
    return {second[0] / all[0], second[1] / all[1]};
}

} // namespace

// The larger one is first. Beside the door some see more of the other.
TEST(Rooms, ADoorPartsThem)
{
    const auto [first, second] = sharesOfSecond(roomsWith(0.8f));
    EXPECT_LT(first, 0.03);
    EXPECT_GT(second, 0.95);
}

TEST(Rooms, SeeEachOtherThroughADoor)
{
    const scenes::Surfaces two = roomsWith(0.8f);
    HitLists hits = scenes::hitListsOf(two, 16);
    tellRoomsApart(two.texels, roomsOfSurfels(two.texels, hits, 8), hits);
    EXPECT_THAT(hits.roomsSeen, ElementsAre(RoomSet(3), RoomSet(3)));
}

TEST(Rooms, SeeNothingOfEachOtherWhereTheyStandApart)
{
    std::vector<Panel> walls = scenes::wallsOf({3.5f, 2.5f, 4.0f});
    std::vector<Panel> second = scenes::wallsOf({3.0f, 2.5f, 4.0f});
    for (Panel& wall : second) wall.corner.x += 5.0f;
    walls.insert(walls.end(), second.begin(), second.end());
    const scenes::Surfaces two(scenes::panels(walls, 96, scenes::plain(glm::vec3(0.5f))));
    HitLists hits = scenes::hitListsOf(two, 16);
    EXPECT_EQ(hits.roomsSeenBy(0), RoomSet().set()); // before they are told apart
    tellRoomsApart(two.texels, roomsOfSurfels(two.texels, hits, 8), hits);
    EXPECT_THAT(hits.roomsSeen, ElementsAre(RoomSet(1), RoomSet(2)));
    for (uint32_t s = 0; s < two.texels.surfels.count(); ++s)
        EXPECT_EQ(hits.roomOf(s), RoomSet(two.texels.surfels.position[s].x < 4.0f ? 1 : 2));
}

TEST(Rooms, AWideGapIsOneRoom)
{
    const auto [first, second] = sharesOfSecond(roomsWith(3.0f));
    EXPECT_EQ(first, 0.0);
    EXPECT_EQ(second, 0.0);
}

TEST(Rooms, MoreThanTheMostAreOfTheOneThatTheySee)
{
    const scenes::Surfaces two = roomsWith(0.8f);
    const HitLists hits = scenes::hitListsOf(two, 16);
    for (const uint8_t room : roomsOfSurfels(two.texels, hits, 1)) EXPECT_EQ(room, 0);
}

// More than half a hundred, of which each is less than a fiftieth of the house.
TEST(Rooms, OfABuildingAreAllToldApart)
{
    constexpr size_t kRooms = 60;
    std::vector<Panel> walls;
    for (size_t room = 0; room < kRooms; ++room)
        for (Panel wall : scenes::wallsOf({2.0f, 2.5f, 2.0f})) {
            wall.corner.x += 2.2f * static_cast<float>(room);
            walls.push_back(wall);
        }
    const scenes::Surfaces building(scenes::panels(walls, 12, scenes::plain(glm::vec3(0.5f))));
    HitLists hits = scenes::hitListsOf(building, 16);
    tellRoomsApart(building.texels, roomsOfSurfels(building.texels, hits, HitTarget::kMostRooms),
                   hits);
    ASSERT_EQ(hits.rooms, kRooms);
    std::vector<int> roomAt(kRooms, -1);
    for (uint32_t s = 0; s < building.texels.surfels.count(); ++s) {
        const float x = building.texels.surfels.position[s].x + 0.1f;
        int& room = roomAt[static_cast<size_t>(x / 2.2f)];
        if (room < 0) room = hits.roomOfSurfel[s];
        ASSERT_EQ(room, hits.roomOfSurfel[s]);
    }
}

// Of two rooms without their ceilings.
TEST(Rooms, EachHasItsOwnSmallHoles)
{
    std::vector<Panel> walls = scenes::wallsOf(kTwoRooms);
    walls.erase(walls.begin() + 1);
    addWall(0.8f, walls);
    const scenes::Surfaces two(scenes::panels(walls, 96, scenes::plain(glm::vec3(0.5f))));
    HitLists hits = scenes::hitListsOf(two, 16);
    for (HitTarget& target : hits.targets)
        if (target.isNothing()) target = HitTarget::nothing();
    hits.shareOfPart.assign(1, 1.0f);
    const std::vector<uint8_t> room = roomsOfSurfels(two.texels, hits, 8);
    tellRoomsApart(two.texels, room, hits);
    EXPECT_EQ(hits.rooms, 2u);
    ASSERT_EQ(hits.shareOfPart.size(), 2u);
    EXPECT_GT(hits.shareOfPart[0], hits.shareOfPart[1]);
    EXPECT_GT(hits.shareOfPart[1], 1.0f);
    for (size_t s = 0; s < room.size(); ++s)
        for (const HitTarget target : hits.targetsOf(s))
            if (target.isNothing()) {
                EXPECT_EQ(target.part(), room[s]);
            }
}

} // namespace relamp
