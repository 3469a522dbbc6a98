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

const Panel kFloor{{0, 0, 0}, {0, 0, 4}, {4, 0, 0}}; // 4 m x 4 m

/// Across the floor at x = 2.
Panel wallOf(float height)
{
    return {{2, 0, 0}, {0, 0, 4}, {0, height, 0}};
}

bool areInOneRoom(std::initializer_list<Panel> panels, glm::vec3 p, glm::vec3 q)
{
    const Scan scan = scenes::panels(std::vector<Panel>(panels), 8, scenes::plain(glm::vec3(0.5f)));
    return areInOneRoom(RayScene(scan), {p, kUp}, {q, kUp});
}

} // namespace

TEST(OneRoom, EndsAtWallsAndNotAtBoards)
{
    EXPECT_TRUE(areInOneRoom({kFloor}, {1, 0, 1}, {3, 0, 1}));
    EXPECT_TRUE(areInOneRoom({kFloor, wallOf(0.3f)}, {1, 0, 1}, {3, 0, 1}));
    EXPECT_TRUE(areInOneRoom({kFloor, wallOf(2.5f)}, {1, 0, 1}, {1, 0, 3}));
    EXPECT_FALSE(areInOneRoom({kFloor, wallOf(2.5f)}, {1, 0, 1}, {3, 0, 1}));
}

// Over its top one looks over the wall, but not from below the table.
TEST(OneRoom, GoesOnUnderTables)
{
    const Panel table{{0, 0.7f, 0}, {0, 0, 4}, {4, 0, 0}};
    EXPECT_TRUE(areInOneRoom({kFloor, table}, {1, 0, 1}, {3, 0, 1}));
    EXPECT_FALSE(areInOneRoom({kFloor, table, wallOf(0.65f)}, {1, 0, 1}, {3, 0, 1}));
}

TEST(OneRoom, PlaceMayLieBehindItsNoisyMesh)
{
    EXPECT_TRUE(areInOneRoom({kFloor}, {1, -0.01f, 1}, {3, -0.01f, 1}));
    EXPECT_FALSE(areInOneRoom({kFloor}, {1, 0, 1}, {3, -0.5f, 1})); // a storey below
}

} // namespace relamp
