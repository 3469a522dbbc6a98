#include "shading/energy_limit.h"

#include "base/radiometry.shared.h"
#include "scenes/axes.h"
#include "scenes/surfaces.h"

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::kUp;

LitSides litBy(const scenes::Surfaces& surfaces, const HitLists& hits, float direct)
{
    const std::vector<uint8_t> noLamps(surfaces.texels.surfels.count(), 0);
    return lightSides(surfaces.texels, hits, surfaces.radiance,
                      std::vector<glm::vec3>(hits.sideOfList.size(), glm::vec3(direct)), noLamps,
                      glm::vec3(0.0f));
}

} // namespace

// A drawer of 0.1 m whose walls of 0.4 see each other and get pi of direct light.
TEST(EnergyLimit, IsWhatTheWhitestPaintSends)
{
    const scenes::Surfaces box(
        scenes::room({0.1f, 0.05f, 0.1f}, 8, scenes::plain(glm::vec3(0.4f))));
    const HitLists hits = scenes::hitListsOf(box, 16);
    const LitSides sides = litBy(box, hits, kPi);
    for (const float limit : energyLimit(box.texels.surfels, hits, sides))
        EXPECT_NEAR(limit, kWhitestPaper * 1.4f, 1e-3f);
}

// In a room a camera sees all, and what shows more than it gets may shine.
TEST(EnergyLimit, IsNoneWhereACameraSees)
{
    scenes::Surfaces box(scenes::room({2, 1.5f, 3}, 32, scenes::plain(glm::vec3(0.4f))));
    const HitLists hits = scenes::hitListsOf(box, 32);
    box.radiance.limit = energyLimit(box.texels.surfels, hits, litBy(box, hits, 0.0f));
    for (uint32_t s = 0; s < box.texels.surfels.count(); ++s)
        EXPECT_EQ(box.radiance.sent(s, glm::vec3(9.0f)), glm::vec3(9.0f));
}

// The underside of a board, which no camera saw: its texture, burnt out or not, is that of what the
// sun shone on, and it is all the light that there would be below it.
TEST(EnergyLimit, WhatIsHiddenInTheDarkLightsNothing)
{
    for (const float shown : {0.8f, 1.0f}) {
        const auto shownAt = [&](glm::vec3, glm::vec3 n) {
            return glm::vec3(n.y < -0.5f ? shown : 0.02f);
        };
        scenes::Surfaces two(
            scenes::panels(std::vector<scenes::Panel>{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}},
                                                      {{0, 0.05f, 0}, {1, 0, 0}, {0, 0, 1}}},
                           32, shownAt));
        const HitLists hits = scenes::hitListsOf(two, 64);
        const uint32_t below = two.at({0.5f, 0, 0.5f}, kUp);
        const LitSides asShown = litBy(two, hits, 0.0f);
        EXPECT_GT(asShown.gathered.irradiance[below].g, 0.9f * shown * kPi);
        two.radiance.limit = energyLimit(two.texels.surfels, hits, asShown);
        EXPECT_LT(litBy(two, hits, 0.0f).gathered.irradiance[below].g, 0.02f * kPi);
    }
}

} // namespace relamp
