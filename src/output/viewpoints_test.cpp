#include "output/viewpoints.h"

#include "scenes/scenes.h"

#include <algorithm>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

/// Rooms that stand apart in one scan, as boxes seen from within.
struct House
{
    std::vector<Bounds> rooms;

    [[nodiscard]] Scan scan() const
    {
        std::vector<scenes::Panel> walls;
        for (const Bounds& room : rooms)
            for (scenes::Panel wall : scenes::wallsOf(room.extent())) {
                wall.corner += room.low;
                walls.push_back(wall);
            }
        return scenes::panels(walls, 4, scenes::plain(glm::vec3(0.5f)));
    }

    /// The index of the room that each camera stands in; -1 for none.
    [[nodiscard]] std::vector<int> roomsOf(const std::vector<Camera>& cameras) const
    {
        std::vector<int> found;
        for (const Camera& camera : cameras) {
            const auto in = std::find_if(rooms.begin(), rooms.end(), [&](const Bounds& room) {
                return room.contains(camera.position);
            });
            found.push_back(in == rooms.end() ? -1 : static_cast<int>(in - rooms.begin()));
        }
        return found;
    }
};

std::vector<int> roomsShown(const House& house, int views)
{
    const Scan scan = house.scan();
    return house.roomsOf(chooseViewpoints(scan, RayScene(scan), views));
}

// Most of the plan of two rooms that lie corner to corner is nothing.
TEST(Viewpoints, LieInRoomsAndNotBetweenThem)
{
    const House house{{{{0, 0, 0}, {5, 2.5f, 4}}, {{14, 0.5f, 12}, {18, 3, 15}}}};

    EXPECT_THAT(roomsShown(house, 2), testing::ElementsAre(0, 1));
}

TEST(Viewpoints, EveryStoreyHasAFloorToStandOn)
{
    const House house{
        {{{0, 0, 0}, {6, 2.7f, 5}}, {{0.5f, 3, 0.5f}, {4.5f, 5.5f, 4}}, {{1, 6, 0}, {5, 8.4f, 4}}}};

    EXPECT_THAT(roomsShown(house, 3), testing::UnorderedElementsAre(0, 1, 2));
    EXPECT_EQ(roomsShown(house, 1).front(), 0) << "the largest";
}

// A closet shows little: two views of the hall beside it show more.
TEST(Viewpoints, ShowALargeRoomTwiceRatherThanAClosetOnce)
{
    const House house{{{{0, 0, 0}, {9, 3, 8}}, {{9.5f, 0, 0}, {10.4f, 2.4f, 0.9f}}}};

    EXPECT_THAT(roomsShown(house, 2), testing::ElementsAre(0, 0));
}

} // namespace
} // namespace relamp
