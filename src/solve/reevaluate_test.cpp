#include "solve/reevaluate.h"

#include "scenes/lit_room.h"
#include "scenes/solved.h"

#include <gmock/gmock.h>

namespace relamp
{

// Nothing is found anew, so nothing may come out otherwise.
TEST(Reevaluate, SamePowersGiveTheSameLight)
{
    scenes::Solved room(scenes::LitRoom().scan);
    const std::vector<glm::vec3> before = room.solved.light->indirect;
    const LampPowers powers = room.solved.found.found.powers;
    ASSERT_FALSE(powers.lamps.empty());
    reevaluate(room.texels, room.solved, powers);
    EXPECT_EQ(room.solved.light->indirect, before);

    LampPowers others = powers;
    others.lamps[0] *= 1.5f;
    reevaluate(room.texels, room.solved, others);
    EXPECT_NE(room.solved.light->indirect, before);
    reevaluate(room.texels, room.solved, powers);
    EXPECT_EQ(room.solved.light->indirect, before);
}

// Light that is read off the texture does not know of powers; that of burnt-out walls does, and
// direct light is in proportion.
TEST(Reevaluate, TwiceThePowerIsTwiceTheDirectLight)
{
    scenes::Solved room(scenes::LitRoom().scan);
    LampPowers powers = room.solved.found.found.powers;
    const std::vector<glm::vec3> once =
        lightOnSurfels(room.texels.surfels, *room.solved.light).irradiance;
    const std::vector<glm::vec3> indirect = room.solved.light->indirect;
    const std::vector<glm::vec3> gathered = room.solved.found.sides.gathered.irradiance;
    for (glm::vec3& radiance : powers.lamps) radiance *= 2.0f;
    reevaluate(room.texels, room.solved, powers);
    const std::vector<glm::vec3> twice =
        lightOnSurfels(room.texels.surfels, *room.solved.light).irradiance;
    for (size_t s = 0; s < once.size(); ++s) {
        const float direct = once[s].g - indirect[s].g;
        EXPECT_NEAR(twice[s].g - room.solved.light->indirect[s].g, 2.0f * direct,
                    1e-4f * once[s].g + 1e-5f);
    }
    // As the rays have it, with their noise: what is lit more is darker paint, and sends as much to
    // what lies behind it, if not a little less.
    for (size_t list = 0; list < gathered.size(); ++list)
        EXPECT_GE(room.solved.found.sides.gathered.irradiance[list].g, 0.999f * gathered[list].g);
}

} // namespace relamp
