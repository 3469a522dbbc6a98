#include "fit/outside.h"

#include "lights/candidates.h"
#include "scenes/sun_room.h"
#include "scenes/surfaces.h"

#include <gtest/gtest.h>

namespace relamp
{

// A ceiling is never a window, however large and bright its panel is.
TEST(Outside, IsSeenThroughAPaneAndNotThroughAPanel)
{
    const scenes::SunRoom sunny(glm::vec3(0.0f), 6.0f);
    const scenes::Surfaces room(sunny.scan);
    FoundLamps lamps;
    for (const Candidate& candidate : findCandidates(room.texels, room.radiance))
        lamps.lamps.push_back({.patches = candidate.patches});
    ASSERT_GE(lamps.lamps.size(), 2u);
    const RayScene outside = sceneWithoutPanes(room.rays, room.texels, room.radiance, lamps);

    const Ray throughPane{scenes::SunRoom::window().at(0.5f, 0.5f) - glm::vec3(1, 0, 0), {1, 0, 0}};
    EXPECT_TRUE(room.rays.occluded(throughPane));
    EXPECT_FALSE(outside.occluded(throughPane));
    for (const FoundLamp& lamp : lamps.lamps) {
        const Candidate surface = candidateOf(lamp.patches);
        if (surface.normal.y < -0.9f) {
            EXPECT_TRUE(outside.occluded({surface.centre - glm::vec3(0, 1, 0), {0, 1, 0}}));
        }
    }
}

} // namespace relamp
