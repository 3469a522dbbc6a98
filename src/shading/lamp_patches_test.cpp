#include "shading/lamp_patches.h"

#include "base/radiometry.shared.h"
#include "scenes/axes.h"
#include "scenes/form_factors.h"
#include "scenes/radiosity.h"
#include "scenes/surfaces.h"
#include "shading/lamp_patches.shared.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::kUp;

/// A pane of a metre squared in the plane z = 0 that looks along z, of patches of 2 cm.
constexpr scenes::Panel kPane{{-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0}};

float openAt(const LampPatches& lamp, glm::vec3 place, glm::vec3 normal,
             InstructionSet set = bestInstructionSet())
{
    TexelBlock block;
    scenes::addTexel(block, place, normal);
    float irradiance[TexelBlock::kPadded];
    openIrradiance(block, lamp, Geometry::exact, irradiance, set);
    return irradiance[0];
}

/// A ball of radius 1 around the origin that shines all around.
AreaLight ball(size_t patches)
{
    std::vector<ClippedPatch> all;
    for (size_t i = 0; i < patches; ++i) { // Fibonacci's spiral
        const float z = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / static_cast<float>(patches);
        const float angle = 2.3999632f * static_cast<float>(i);
        const float r = std::sqrt(1.0f - z * z);
        const glm::vec3 n(r * std::cos(angle), r * std::sin(angle), z);
        all.push_back({n, n, 4.0f * kPi / static_cast<float>(patches), 0});
    }
    return AreaLight(std::move(all));
}

} // namespace

TEST(LampPatches, EveryPatchIsTheSumOfItsParts)
{
    const LampPatches lamp(scenes::lightOf(kPane, 50));
    EXPECT_NEAR(lamp.area[0], 1.0f, 1e-4f);
    EXPECT_EQ(lamp.after[0], lamp.count());
    for (uint32_t i = 0; i < lamp.count(); ++i) {
        EXPECT_LT(lamp.depth[i], kMostDepth);
        float area = 0.0f;
        for (uint32_t part = i + 1; part < lamp.after[i]; part = lamp.after[part])
            area += lamp.area[part];
        if (lamp.after[i] == i + 1) continue; // has none
        EXPECT_NEAR(area, lamp.area[i], 1e-4f * area);
    }
}

// Reveals and frames stand a few centimetres beside a pane.
TEST(LampPatches, BesideAPaneItsLightIsLambertsPolygon)
{
    const LampPatches lamp(scenes::lightOf(kPane, 50));
    const scenes::Panel pane = kPane;
    for (const float off : {0.01f, 0.02f, 0.05f, 0.2f, 0.7f, 3.0f}) {
        const glm::vec3 reveal(0.1f, -0.5f, off); // looks up along the pane
        const float besides = scenes::irradianceFrom(pane, reveal, kUp);
        EXPECT_NEAR(openAt(lamp, reveal, kUp), besides, 0.12f * besides) << off;
        const glm::vec3 before(0.103f, 0.207f, off);
        const float opposite = scenes::irradianceFrom(pane, before, {0, 0, -1});
        EXPECT_NEAR(openAt(lamp, before, {0, 0, -1}), opposite, 0.12f * opposite) << off;
    }
}

TEST(LampPatches, FromAfarFewPatchesAreAsGoodAsAll)
{
    const scenes::Panel pane = kPane;
    const LampPatches lamp(scenes::lightOf(pane, 50));
    const float exact = scenes::irradianceFrom(pane, {0.4f, -0.5f, 2.0f}, kUp);
    EXPECT_NEAR(openAt(lamp, {0.4f, -0.5f, 2.0f}, kUp), exact, 0.01f * exact);
}

// A ceiling on floor and walls, as people's lights are computed and as a scan's own lamps are.
TEST(LampPatches, CeilingLightsFloorAndWallsByTheTextbook)
{
    const std::vector<scenes::Panel> walls = scenes::wallsOf({4.0f, 2.5f, 5.0f});
    const LampPatches lamp(scenes::lightOf(walls[1], 250));
    const auto meanOver = [&](const scenes::Panel& wall, Geometry geometry) {
        constexpr int kAcross = 100;
        double sum = 0.0;
        for (int v = 0; v < kAcross; ++v) {
            TexelBlock block;
            for (int u = 0; u < kAcross; ++u)
                scenes::addTexel(block,
                                 wall.at((static_cast<float>(u) + 0.5f) / kAcross,
                                         (static_cast<float>(v) + 0.5f) / kAcross),
                                 wall.normal());
            float irradiance[TexelBlock::kPadded];
            openIrradiance(block, lamp, geometry, irradiance);
            for (int u = 0; u < kAcross; ++u) sum += static_cast<double>(irradiance[u] / kPi);
        }
        return sum / (kAcross * kAcross);
    };
    const double onFloor = scenes::opposite(4.0, 5.0, 2.5);
    const double onWall = scenes::adjacent(5.0, 2.5, 4.0); // x = 0
    for (const Geometry geometry : {Geometry::exact, Geometry::scanned}) {
        EXPECT_NEAR(meanOver(walls[0], geometry), onFloor, 0.005 * onFloor);
        EXPECT_NEAR(meanOver(walls[2], geometry), onWall, 0.005 * onWall);
    }
}

// One patch hands over to its parts by and by: no step shows on a wall.
TEST(LampPatches, LightHasNoStepsAlongAWall)
{
    const LampPatches lamp(scenes::lightOf(kPane, 50));
    float former = openAt(lamp, {0, -0.5f, 0.3f}, kUp);
    for (float z = 0.301f; z < 4.0f; z += 0.001f) {
        const float here = openAt(lamp, {0, -0.5f, z}, kUp);
        EXPECT_LT(std::abs(here - former), 0.01f * former) << z;
        former = here;
    }
}

// A pane that shines to both sides has no mean facing.
TEST(LampPatches, BothSidesOfAPaneShine)
{
    const AreaLight front = scenes::lightOf(kPane, 10);
    std::vector<ClippedPatch> patches(front.patches().begin(), front.patches().end());
    for (const ClippedPatch& patch : front.patches()) {
        patches.push_back(patch);
        patches.back().normal = -patch.normal;
    }
    const LampPatches both{AreaLight(patches)};
    const LampPatches one(front);
    const float expected = openAt(one, {0.2f, 0, 2}, {0, 0, -1});
    EXPECT_NEAR(openAt(both, {0.2f, 0, 2}, {0, 0, -1}), expected, 1e-4f * expected);
    EXPECT_NEAR(openAt(both, {0.2f, 0, -2}, {0, 0, 1}), expected, 1e-4f * expected);
}

// A ball of radiance 1 and radius 1 is a point of intensity pi.
TEST(LampPatches, ABallShinesAllAroundAlike)
{
    const LampPatches lamp(ball(2000));
    std::mt19937 random(3);
    const auto number = [&] { return static_cast<float>(random() % 2001) / 1000.0f - 1.0f; };
    for (int i = 0; i < 20; ++i) {
        const glm::vec3 to = glm::normalize(glm::vec3(number(), number(), number()) + 1e-3f);
        EXPECT_NEAR(openAt(lamp, 8.0f * to, -to), kPi / 64.0f, 0.05f * kPi / 64.0f);
    }
}

TEST(LampPatches, AllInstructionSetsAgree)
{
    const LampPatches lamp(scenes::lightOf(kPane, 20));
    for (const glm::vec3 place : {glm::vec3(0, -0.5f, 0.04f), glm::vec3(0.3f, -0.5f, 1.1f)}) {
        const float baseline = openAt(lamp, place, kUp, InstructionSet::baseline);
        for (const InstructionSet set : scenes::widerSets())
            EXPECT_NEAR(openAt(lamp, place, kUp, set), baseline, 1e-5f * baseline);
    }
}

} // namespace relamp
