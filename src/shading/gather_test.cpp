#include "shading/gather.h"

#include "base/radiometry.shared.h"
#include "scenes/axes.h"
#include "scenes/form_factors.h"
#include "scenes/lit_room.h"
#include "scenes/radiosity.h"
#include "scenes/surfaces.h"

#include <utility>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::kUp;

constexpr glm::vec3 kGatherRoom(2.0f, 1.5f, 3.0f);

/// A dark room under a ceiling of radiance 0.9.
Scan brightCeiling()
{
    return scenes::room(kGatherRoom, 32, [](glm::vec3, glm::vec3 n) {
        return glm::vec3(n.y < -0.5f ? 0.9f : 0.0f);
    });
}

} // namespace

// A closed box whose walls emit e and reflect rho shows e / (1 - rho) everywhere; what it gathers
// of that, and reflects, makes up just that with what it emits.
TEST(Gather, FurnaceKeepsTheGeometricSeries)
{
    const float emission = 0.3f;
    for (const float rho : {0.2f, 0.5f, 0.65f}) {
        const float shown = emission / (1.0f - rho);
        const scenes::Surfaces box(scenes::room(kGatherRoom, 32, scenes::plain(glm::vec3(shown))));
        const Gathered gathered = gather(scenes::hitListsOf(box, 32), fieldOf(box.radiance));
        for (const glm::vec3 irradiance : gathered.irradiance)
            ASSERT_NEAR(emission + rho * irradiance.g / kPi, shown, 0.005f * shown) << rho;
    }
}

// Radiance L from everywhere is an irradiance of pi L, however the rays fall.
TEST(Gather, FurnaceGivesPiTimesItsRadiance)
{
    const glm::vec3 radiance(0.4f, 0.2f, 0.1f);
    const scenes::Surfaces box(scenes::room(kGatherRoom, 32, scenes::plain(radiance)));
    const Gathered gathered = gather(scenes::hitListsOf(box, 32), fieldOf(box.radiance));
    for (const glm::vec3 irradiance : gathered.irradiance)
        EXPECT_LT(glm::distance(irradiance, kPi * radiance), 2e-3f); // half floats
    EXPECT_THAT(gathered.missed, testing::Each(0.0f));
    EXPECT_THAT(gathered.noise, testing::Each(testing::Lt(2e-3f)));
}

// Rays that are even err by less than as many at random.
TEST(Gather, NoiseIsWhatOtherRaysDifferBy)
{
    scenes::Surfaces room(scenes::LitRoom().scan);
    const auto gathered = [&](uint32_t seed) {
        room.texels.surfels.seed = seed;
        return gather(scenes::hitListsOf(room, 38), fieldOf(room.radiance));
    };
    float differed = 0.0f;
    float expected = 0.0f;
    for (const uint32_t seed : {1u, 2u, 3u, 4u}) {
        const Gathered one = gathered(seed);
        const Gathered other = gathered(seed + 10);
        for (size_t s = 0; s < room.texels.surfels.count(); ++s) {
            const float step = luminance(one.irradiance[s]) - luminance(other.irradiance[s]);
            differed += step * step;
            expected += one.noise[s] * one.noise[s] + other.noise[s] * other.noise[s];
        }
    }
    EXPECT_NEAR(differed / expected, 1.0f, 0.1f);
}

// A wall that a warm lamp burnt out sends no white: what is whole of its colour is known.
TEST(Gather, BurntOutWallSendsWhatTheTextureShowsOfIt)
{
    const glm::vec3 warm(1.0f, 0.6f, 0.2f);
    Scan scan = scenes::room(kGatherRoom, 32, scenes::plain(warm));
    scan.pages[0].image.clipsAtWhite = true;
    const scenes::Surfaces box(std::move(scan));
    ASSERT_THAT(box.radiance.plainArea, testing::Each(0.0f));
    const Gathered gathered = gather(scenes::hitListsOf(box, 32), fieldOf(box.radiance));
    for (const glm::vec3 irradiance : gathered.irradiance)
        EXPECT_LT(glm::distance(irradiance, kPi * warm), 2e-3f);
}

// What leaves through a hole is missing in the irradiance and stands in `missed`.
TEST(Gather, WhatIsMissedMakesItWholeAgain)
{
    std::vector<scenes::Panel> walls = scenes::wallsOf(kGatherRoom);
    walls.erase(walls.begin() + 1);
    const scenes::Surfaces box(scenes::panels(walls, 32, scenes::plain(glm::vec3(0.5f))));
    const HitLists hits = scenes::hitListsOf(box, 32);
    const Gathered gathered = gather(hits, fieldOf(box.radiance));
    for (size_t s = 0; s < box.texels.surfels.count(); ++s)
        EXPECT_NEAR(gathered.irradiance[s].g + 0.5f * gathered.missed[s], kPi * 0.5f, 2e-3f);
}

TEST(Gather, CeilingLightsTheFloorByItsFormFactor)
{
    const scenes::Surfaces box(brightCeiling());
    const Gathered gathered = gather(scenes::hitListsOf(box, 64), fieldOf(box.radiance));
    const scenes::Panel ceiling = scenes::wallsOf(kGatherRoom)[1];
    float sum = 0.0f;
    float expected = 0.0f;
    size_t far = 0;
    const std::vector<uint32_t> floor = box.facing(kUp);
    for (const uint32_t s : floor) {
        const float exact =
            0.9f * scenes::irradianceFrom(ceiling, box.texels.surfels.position[s], kUp);
        far += std::abs(gathered.irradiance[s].g - exact) > 2.0f * gathered.noise[s] ? 1u : 0u;
        sum += gathered.irradiance[s].g;
        expected += exact;
    }
    EXPECT_NEAR(sum, expected, 0.01f * expected);
    EXPECT_LT(far, floor.size() / 20); // two standard errors, and even points beat random ones
}

// The same all over floor and walls, by their configuration factors.
TEST(Gather, CeilingLightsFloorAndWallsByTheTextbook)
{
    const scenes::Surfaces box(brightCeiling());
    const Gathered gathered = gather(scenes::hitListsOf(box, 256), fieldOf(box.radiance));
    const auto meanOf = [&](glm::vec3 normal) {
        double sum = 0.0;
        double area = 0.0;
        for (const uint32_t s : box.facing(normal)) {
            const auto own = static_cast<double>(box.texels.surfels.area[s]);
            sum += own * static_cast<double>(gathered.irradiance[s].g / (0.9f * kPi));
            area += own;
        }
        return sum / area;
    };
    const double onFloor = scenes::opposite(2.0, 3.0, 1.5);
    EXPECT_NEAR(meanOf(kUp), onFloor, 0.005 * onFloor);
    const double onWall = scenes::adjacent(3.0, 1.5, 2.0);
    EXPECT_NEAR(meanOf({1, 0, 0}), onWall, 0.005 * onWall);
}

TEST(Gather, LampsAreLeftOut)
{
    const scenes::Surfaces box(scenes::room(kGatherRoom, 32, [](glm::vec3, glm::vec3 n) {
        return glm::vec3(n.y < -0.5f ? 1.0f : 0.0f);
    }));
    const HitLists hits = scenes::hitListsOf(box, 16);
    RadianceField field = fieldOf(box.radiance);
    const uint32_t floor = box.at({1.0f, 0.0f, 1.5f}, kUp);
    EXPECT_GT(gather(hits, field).irradiance[floor].g, 0.5f);
    field.shines.assign(field.shines.size(), 1);
    EXPECT_EQ(gather(hits, field).irradiance[floor].g, 0.0f);
}

TEST(Gather, SomeListsGiveWhatAllGive)
{
    const scenes::Surfaces box(brightCeiling());
    const HitLists hits = scenes::hitListsOf(box, 16);
    const RadianceField field = fieldOf(box.radiance);
    const Gathered all = gather(hits, field);
    const std::vector<uint32_t> lists = box.facing(kUp);
    const Gathered some = gather(hits, field, lists);
    ASSERT_EQ(some.irradiance.size(), lists.size());
    for (size_t i = 0; i < lists.size(); ++i) {
        EXPECT_EQ(some.irradiance[i], all.irradiance[lists[i]]);
        EXPECT_EQ(some.noise[i], all.noise[lists[i]]);
    }
}

// Only what is not plain changes while light settles.
TEST(Gather, SettlingGivesWhatTheWholeGives)
{
    std::vector<scenes::Panel> walls = scenes::wallsOf(kGatherRoom);
    walls.push_back(
        {{0.5f, 0.7f, 0.5f}, {0.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f}}); // seen from below
    walls.erase(walls.begin() + 2);
    Scan scan = scenes::panels(walls, 32, [](glm::vec3, glm::vec3 n) {
        return n.y < -0.5f ? glm::vec3(1.0f) : glm::vec3(0.3f, 0.4f, 0.5f);
    });
    scan.pages[0].image.clipsAtWhite = true;
    const scenes::Surfaces box(std::move(scan));
    const HitLists hits = scenes::hitListsOf(box, 32);
    RadianceField field = fieldOf(box.radiance);
    RadianceField before = field;
    before.plain.assign(before.plain.size(), glm::vec3(0.7f));
    SettlingGather settling(hits, before);
    settling.takePlain(hits, field);
    field.clipped.assign(field.clipped.size(), glm::vec3(2.0f, 3.0f, 4.0f));
    field.back.assign(field.back.size(), glm::vec3(0.1f, 0.2f, 0.3f));
    for (size_t s = 0; s < field.shines.size(); s += 2) field.shines[s] = 1;
    const Gathered whole = gather(hits, field);
    const Gathered settled = settling.gather(field);
    EXPECT_THAT(whole.missed, testing::Contains(testing::Gt(0.0f)));
    ASSERT_EQ(settled.irradiance.size(), whole.irradiance.size());
    for (size_t i = 0; i < whole.irradiance.size(); ++i) {
        EXPECT_LT(glm::distance(settled.irradiance[i], whole.irradiance[i]), 1e-4f);
        EXPECT_FLOAT_EQ(settled.missed[i], whole.missed[i]);
    }
}

} // namespace relamp
