#include "shading/seen.h"

#include "scenes/scenes.h"
#include "scenes/surfaces.h"

#include <gtest/gtest.h>

namespace relamp
{

// One dark surfel in a lit square: it and the ring around it may have an edge within, all others
// see everything.
TEST(Seen, IsSureOnlyWhereTheRingAroundAgrees)
{
    const scenes::Surfaces square(scenes::square(2.0f, 64, scenes::plain(glm::vec3(0.5f))));
    const Surfels& surfels = square.texels.surfels;
    std::vector<AreaSample> coarse(surfels.count(), {.open = 1.0f, .visible = 1.0f});
    const uint32_t dark = square.at({1.0f, 0.0f, 1.0f}, {0, 1, 0});
    coarse[dark].visible = 0.0f;
    const std::vector<Seen> seen = seenBySurfels(surfels, LampSight(coarse));
    for (uint32_t s = 0; s < surfels.count(); ++s) {
        const float away = glm::distance(surfels.position[s], surfels.position[dark]);
        EXPECT_EQ(seen[s], away < 1.7f * surfels.size ? Seen::some : Seen::all) << away;
    }
}

// What is behind a light's back sees nothing of it, and is sure of that.
TEST(Seen, WhatALightCannotReachSeesNothing)
{
    const scenes::Surfaces square(scenes::square(2.0f, 32, scenes::plain(glm::vec3(0.5f))));
    for (const Seen seen :
         seenBySurfels(square.texels.surfels, LampSight(square.texels.surfels.count())))
        EXPECT_EQ(seen, Seen::none);
}

} // namespace relamp
