#include "scan/wall_frame.h"

#include "scenes/scenes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

/// The walls of a room that stands turned by `turn` (rad).
Scan roomTurnedBy(double turn)
{
    const WallFrame turned(turn);
    std::vector<scenes::Panel> walls = scenes::wallsOf({4.0f, 2.5f, 3.0f});
    for (scenes::Panel& wall : walls)
        wall = {turned.fromScan(wall.corner), turned.fromScan(wall.alongU),
                turned.fromScan(wall.alongV)};
    return scenes::panels(walls, 32, scenes::plain(glm::vec3(0.5f)));
}

} // namespace

TEST(WallFrame, LeavesARoomThatStandsAboutStraight)
{
    const glm::vec3 place(1.0f, 2.0f, 3.0f);
    for (const double turn : {0.0, 0.005, -0.007})
        EXPECT_EQ(wallFrameOf(roomTurnedBy(turn)).fromScan(place), place);
}

TEST(WallFrame, LiesAlongTheWallsHoweverTheyStand)
{
    for (const double turn : {0.02, 0.5, 0.785, 1.3, 2.9, -2.0}) {
        const Scan room = roomTurnedBy(turn);
        const WallFrame frame = wallFrameOf(room);
        for (const glm::vec3 normal : room.meshes[0].normals) {
            const glm::vec3 facing = glm::abs(frame.fromScan(normal));
            EXPECT_GT(std::max({facing.x, facing.y, facing.z}), 0.9999f) << turn; // 0.8 degrees
            EXPECT_LT(glm::distance(frame.toScan(frame.fromScan(normal)), normal), 1e-6f);
        }
    }
}

TEST(WallFrame, OfAFloorIsTheScansOwn)
{
    const glm::vec3 place(1.0f, 2.0f, 3.0f);
    EXPECT_EQ(wallFrameOf(scenes::square(2.0f, 32, scenes::plain(glm::vec3(0.5f)))).fromScan(place),
              place);
}

} // namespace relamp
