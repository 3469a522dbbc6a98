#include "solve/find_room.h"

#include "scenes/lit_room.h"
#include "scenes/surfaces.h"

#include <gtest/gtest.h>

namespace relamp
{

// What hid in the dark under other light may be seen in this one.
TEST(FindRoom, LimitsOfAnotherLightAreForgotten)
{
    const scenes::Surfaces room(scenes::LitRoom().scan);
    DelightOptions options;
    options.gather.quality = Quality::draft;
    options.gather.response = Response(); // a camera that changed nothing: the radiance stays, too
    options.gather.gain = false;
    Progress progress;
    FoundRoom before = findRoom(room.texels, room.rays, options, progress);
    const LampPowers powers = before.found.powers;
    const std::vector<float> limit = before.radiance.limit;
    ASSERT_EQ(limit.size(), room.texels.surfels.count());
    before.radiance.limit.assign(limit.size(), 0.0f);
    const FoundRoom again = findRoom(room.texels, room.rays, options, progress, &before);
    EXPECT_EQ(again.found.powers.lamps, powers.lamps);
    EXPECT_EQ(again.radiance.limit, limit);
}

} // namespace relamp
