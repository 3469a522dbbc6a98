#include "rooms/bake.h"
#include "rooms/builder.h"
#include "rooms/furnish.h"

#include <gtest/gtest.h>

namespace relamp::rooms
{
namespace
{

constexpr int kSide = 64; // pixels

/// What is true at the texel of `atlas` whose place is nearest to `wanted`, of patch-like charts
/// that face up.
size_t pixelAt(const Atlas& atlas, glm::vec3 wanted)
{
    size_t nearest = 0;
    float least = 1e9f;
    for (const Chart& chart : atlas.charts)
        for (int y = 0; y < chart.pixels.y; ++y)
            for (int x = 0; x < chart.pixels.x; ++x) {
                const glm::vec2 at = (glm::vec2(x, y) + 0.5f) / glm::vec2(chart.pixels);
                const float off = glm::distance(chart.patch.at(at.x, at.y), wanted);
                if (off >= least || chart.patch.normalAt(at.x, at.y).y < 0.9f) continue;
                least = off;
                const glm::ivec2 pixel = chart.corner + glm::ivec2(x, y);
                nearest = static_cast<size_t>(pixel.y * atlas.side + pixel.x);
            }
    return nearest;
}

/// Form factor of a square at a distance of its own side, seen from the point below its middle
/// (Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", B-4).
constexpr float kFormFactor = 0.2395f;

} // namespace

// A closed box whose walls emit e and reflect rho settles at e / (1 - rho).
TEST(Bake, FurnaceReachesTheGeometricSeries)
{
    Builder b(1);
    const int grey = b.add({.first = glm::vec3(0.5f)});
    const int lamp = b.addLamp("walls", glm::vec3(1.0f));
    b.box({}, {0, 0, 0}, {1, 1, 1}, grey, allFaces, lamp);
    for (Patch& patch : b.room.patches) { // seen from inside
        std::swap(patch.alongU, patch.alongV);
    }
    const Atlas atlas = layOut(b.room, kSide);
    const Baked baked = bake(b.room, atlas, {.lampRays = 64, .bounceRays = 64});
    double sum = 0.0;
    double count = 0.0;
    for (size_t p = 0; p < atlas.pixels(); ++p)
        if (baked.isCovered[p] != 0) {
            EXPECT_FALSE(baked.isHidden[p]);
            sum += static_cast<double>(baked.direct[p].g + baked.indirect[p].g);
            count += 1.0;
        }
    EXPECT_NEAR(sum / count, 2.0, 0.02);
}

TEST(Bake, PanelLightsTheFloorByItsFormFactor)
{
    Builder b(1);
    const int black = b.add({.first = glm::vec3(0.0f)}); // as black as there is
    b.panel({}, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, black);
    b.panel({}, {-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}, black,
            b.addLamp("panel", glm::vec3(3.0f)));
    const Atlas atlas = layOut(b.room, kSide);
    const Baked baked = bake(b.room, atlas, {.lampRays = 1024, .bounceRays = 256});
    EXPECT_NEAR(baked.direct[pixelAt(atlas, {})].g, 3.0f * kFormFactor, 0.01f);
}

// The same panel as an opening, under an even sky.
TEST(Bake, OpeningLightsTheFloorLikeAPanel)
{
    Builder b(1);
    const int black = b.add({.first = glm::vec3(0.0f)});
    b.panel({}, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, black);
    b.room.openings.push_back({{-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}});
    b.room.outside = {glm::vec3(3.0f), glm::vec3(3.0f), glm::vec3(3.0f)};
    const Atlas atlas = layOut(b.room, kSide);
    const Baked baked = bake(b.room, atlas, {.lampRays = 1024, .bounceRays = 256});
    EXPECT_NEAR(baked.indirect[pixelAt(atlas, {})].g, 3.0f * kFormFactor, 0.01f);
    EXPECT_EQ(baked.direct[pixelAt(atlas, {})].g, 0.0f);
}

TEST(Plans, EveryRoomHasTheLampsOfItsPlan)
{
    for (const Plan& plan : allPlans()) {
        const Room room = furnish(plan);
        const int lamps = plan.panels.x * plan.panels.y + plan.globes + plan.domes +
                          plan.tableLamps + plan.sconces + plan.panes;
        EXPECT_EQ(static_cast<int>(room.lamps.size()), lamps) << plan.name;
        EXPECT_GT(layOut(room, 448).charts.size(), 100u) << plan.name;
    }
}

} // namespace relamp::rooms
