#include "output/lights_in_the_open.h"

#include "scenes/scenes.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

/// A room of 3 x 2.5 x 4 m, from 0 on.
struct Box
{
    Scan scan = scenes::room({3.0f, 2.5f, 4.0f}, 16, scenes::plain(glm::vec3(0.5f)));
    RayScene scene{scan};

    [[nodiscard]] glm::vec3 placeOf(glm::vec3 position, glm::vec3 normal) const
    {
        return inTheOpen({{.position = position, .normal = normal}}, scene).front().position;
    }
};

} // namespace

// A pane whose middle lies 5 cm behind the wall shines into the room from 2 cm before it.
TEST(LightsInTheOpen, APaneBehindItsWallComesThrough)
{
    const glm::vec3 place = Box().placeOf({-0.05f, 1.0f, 2.0f}, {1.0f, 0.0f, 0.0f});
    EXPECT_LT(glm::distance(place, {0.02f, 1.0f, 2.0f}), 1e-4f);
}

TEST(LightsInTheOpen, WhatStandsFreeStaysAndSoDoesAGlobe)
{
    const glm::vec3 free(1.0f, 2.0f, 1.0f);
    EXPECT_EQ(Box().placeOf(free, {0.0f, -1.0f, 0.0f}), free);
    const glm::vec3 behind(-0.05f, 1.0f, 2.0f);
    EXPECT_EQ(Box().placeOf(behind, glm::vec3(0.0f)), behind);
}

} // namespace relamp
