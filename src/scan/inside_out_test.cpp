#include "scan/inside_out.h"

#include "scenes/scenes.h"
#include "scenes/surfaces.h"

#include <utility>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr glm::vec3 kRoom(4.0f, 2.5f, 5.0f);

/// The walls of a room and of what stands in it.
std::vector<scenes::Panel> furnishedRoom()
{
    std::vector<scenes::Panel> panels = scenes::wallsOf(kRoom);
    for (scenes::Panel side : scenes::wallsOf({1.5f, 1.0f, 2.0f})) {
        side.corner += glm::vec3(1.0f, 0.01f, 1.0f);
        std::swap(side.alongU, side.alongV); // seen from outside
        panels.push_back(side);
    }
    return panels;
}

bool isInsideOut(const std::vector<scenes::Panel>& panels)
{
    const scenes::Surfaces room(scenes::panels(panels, 32, scenes::plain(glm::vec3(0.5f))));
    return isInsideOut(room.texels.surfels, room.rays);
}

} // namespace

TEST(InsideOut, IsARoomOfWhichAllIsTurnedRound)
{
    std::vector<scenes::Panel> panels = furnishedRoom();
    EXPECT_FALSE(isInsideOut(panels));
    for (scenes::Panel& panel : panels) std::swap(panel.alongU, panel.alongV);
    EXPECT_TRUE(isInsideOut(panels));
}

// The outsides of their walls see each other, as those of one that is turned round.
TEST(InsideOut, AreNoRoomsBesideEachOther)
{
    std::vector<scenes::Panel> panels;
    for (int i = 0; i < 9; ++i)
        for (scenes::Panel wall : scenes::wallsOf(kRoom)) {
            wall.corner +=
                glm::vec3(4.2f * static_cast<float>(i % 3), 0.0f, 5.2f * static_cast<float>(i / 3));
            panels.push_back(wall);
        }
    EXPECT_FALSE(isInsideOut(panels));
}

TEST(InsideOut, IsNoPartOfARoom)
{
    const std::vector<scenes::Panel> walls = scenes::wallsOf(kRoom);
    EXPECT_FALSE(isInsideOut({walls[0], walls[2], walls[4]})); // a corner and the floor
    EXPECT_FALSE(isInsideOut({walls[0]}));
}

} // namespace relamp
