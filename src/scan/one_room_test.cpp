#include "scan/one_room.h"

#include "scenes/axes.h"
#include "scenes/scenes.h"

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::kUp;
using scenes::Panel;

/// Across the room at x = 2.
Panel wallOf(float height)
{
    return {{2, 0, 0}, {0, 0, 4}, {0, height, 0}};
}

/// A room of 4 m x 4 m with these in it.
Scan roomWith(std::initializer_list<Panel> panels)
{
    std::vector<Panel> all = scenes::wallsOf({4.0f, 2.5f, 4.0f});
    all.insert(all.end(), panels);
    return scenes::panels(all, 8, scenes::plain(glm::vec3(0.5f)));
}

bool areInOneRoom(std::initializer_list<Panel> panels, glm::vec3 p, glm::vec3 q)
{
    return areInOneRoom(RayScene(roomWith(panels)), {p, kUp}, {q, kUp});
}

bool areOnOneFloor(std::initializer_list<Panel> panels, glm::vec3 p, glm::vec3 q)
{
    return areInOneRoomOfPlane(RayScene(roomWith(panels)), {p, kUp}, {q, kUp});
}

} // namespace

TEST(OneRoom, EndsAtWallsAndNotAtBoards)
{
    EXPECT_TRUE(areInOneRoom({}, {1, 0, 1}, {3, 0, 1}));
    EXPECT_TRUE(areInOneRoom({wallOf(0.3f)}, {1, 0, 1}, {3, 0, 1}));
    EXPECT_TRUE(areInOneRoom({wallOf(2.5f)}, {1, 0, 1}, {1, 0, 3}));
    EXPECT_FALSE(areInOneRoom({wallOf(2.5f)}, {1, 0, 1}, {3, 0, 1}));
    EXPECT_TRUE(areOnOneFloor({wallOf(0.3f)}, {1, 0, 1}, {3, 0, 1}));
    EXPECT_FALSE(areOnOneFloor({wallOf(2.5f)}, {1, 0, 1}, {3, 0, 1}));
}

// What stands between them under a table is no wall; over the table one looks over it.
TEST(OneRoom, OfAFloorGoesOnUnderWhatStandsOnIt)
{
    const Panel table{{0, 0.7f, 0}, {0, 0, 4}, {4, 0, 0}};
    EXPECT_TRUE(areOnOneFloor({table, wallOf(0.65f)}, {1, 0, 1}, {3, 0, 1}));
}

// Of a room that has the shape of an L.
TEST(OneRoom, GoesAroundACorner)
{
    const Panel corner{{2, 0, 2}, {0, 0, 2}, {0, 2.5f, 0}};
    const Panel other{{2, 0, 2}, {2, 0, 0}, {0, 2.5f, 0}};
    EXPECT_TRUE(areOnOneFloor({corner, other}, {1, 0, 3.5f}, {3.5f, 0, 1}));
    EXPECT_FALSE(areOnOneFloor({corner, other, wallOf(2.5f)}, {1, 0, 3.5f}, {3.5f, 0, 1}));
}

// Over its top one looks over the wall, but not from below the table.
TEST(OneRoom, GoesOnUnderTables)
{
    const Panel table{{0, 0.7f, 0}, {0, 0, 4}, {4, 0, 0}};
    EXPECT_TRUE(areInOneRoom({table}, {1, 0, 1}, {3, 0, 1}));
    EXPECT_FALSE(areInOneRoom({table, wallOf(0.65f)}, {1, 0, 1}, {3, 0, 1}));
}

TEST(OneRoom, PlaceMayLieBehindItsNoisyMesh)
{
    EXPECT_TRUE(areInOneRoom({}, {1, -0.01f, 1}, {3, -0.01f, 1}));
    EXPECT_FALSE(areInOneRoom({}, {1, 0, 1}, {3, -0.5f, 1})); // a storey below
}

} // namespace relamp
