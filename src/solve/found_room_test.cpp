#include "solve/found_room.h"

#include <gmock/gmock.h>

namespace relamp
{

// What a lamp has beyond the scan is no surfel; one that is off is wall, a patch of sun no lamp.
TEST(FoundRoom, SurfelsOfLampsThatAreOnShine)
{
    FoundRoom room;
    room.radiance.plain.resize(4);
    for (const uint32_t surfel : {2u, 1u, 0u})
        room.found.lamps.push_back({{{{}, {0, 1, 0}, 1.0f, surfel}}});
    room.found.lamps[0].patches.push_back({{}, {0, 1, 0}, 1.0f, Surfels::kNone});
    room.found.lamps[2].isSunlit = true;
    room.found.powers.lamps = {glm::vec3(1.0f), glm::vec3(0.0f), glm::vec3(1.0f)};
    EXPECT_THAT(shinesOf(room, room.found.powers), testing::ElementsAre(1, 0, 1, 0));
    EXPECT_THAT(shiningOf(room).surfels, testing::ElementsAre(0, 0, 1, 0));
}

} // namespace relamp
