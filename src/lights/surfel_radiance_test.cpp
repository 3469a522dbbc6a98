#include "lights/surfel_radiance.h"

#include "scenes/axes.h"
#include "scenes/scenes.h"
#include "scenes/surfaces.h"

#include <numeric>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::kUp;

/// 2 m squared of radiance 0.3; its half beyond x = 1.24 is burnt out.
scenes::Paint halfBurntOut()
{
    return [](glm::vec3 p, glm::vec3) { return glm::vec3(p.x > 1.24f ? 1.0f : 0.3f); };
}

float sumOf(const std::vector<float>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0f);
}

} // namespace

TEST(SurfelRadiance, EveryTexelIsPlainOrBurntOut)
{
    const scenes::Surfaces floor(scenes::square(2.0f, 200, halfBurntOut()));
    EXPECT_NEAR(sumOf(floor.radiance.plainArea), 2.0f * 1.24f, 0.01f);
    EXPECT_NEAR(sumOf(floor.radiance.clippedArea), 2.0f * 0.76f, 0.01f);
    size_t marked = 0;
    for (const bool clipped : floor.radiance.isClipped[0]) marked += clipped ? 1 : 0;
    EXPECT_EQ(marked, 200u * 76u);
}

// White beside grey does not make the grey of a surfel brighter.
TEST(SurfelRadiance, PlainIsTheMeanOfWhatIsNotBurntOut)
{
    const scenes::Surfaces floor(scenes::square(2.0f, 200, halfBurntOut()));
    size_t mixed = 0;
    for (size_t s = 0; s < floor.texels.surfels.count(); ++s) {
        if (floor.radiance.plainArea[s] == 0.0f) continue;
        EXPECT_NEAR(floor.radiance.plain[s].g, 0.3f, 1e-3f);
        mixed += floor.radiance.clippedArea[s] > 0.0f ? 1u : 0u;
    }
    EXPECT_GT(mixed, 10u);
    EXPECT_EQ(floor.radiance.plain[floor.at({1.8f, 0.0f, 1.0f}, kUp)], glm::vec3(1.0f));
}

TEST(SurfelRadiance, PatchesAreWhereTheBurntOutTexelsAre)
{
    const scenes::Surfaces floor(scenes::square(2.0f, 200, halfBurntOut()));
    ASSERT_FALSE(floor.radiance.clipped.empty());
    uint32_t last = 0;
    for (const ClippedPatch& patch : floor.radiance.clipped) {
        EXPECT_GT(patch.position.x, 1.24f);
        EXPECT_NEAR(patch.normal.y, 1.0f, 1e-5f);
        EXPECT_GE(patch.surfel, last);
        last = patch.surfel;
    }
}

// An exposure of 0.6 where it is burnt out, of 4 elsewhere: what is brighter than white then was
// seen as it is, and what is burnt out stays so.
TEST(SurfelRadiance, BurntOutIsWhatTheTextureShowsWhateverItsGain)
{
    const scenes::Surfaces floor(scenes::square(2.0f, 200, halfBurntOut()));
    Linearization linearization;
    for (const glm::vec3 p : floor.texels.surfels.position)
        linearization.perGain.emplace_back(p.x > 1.24f ? 0.6f : 4.0f);
    Progress progress;
    const SurfelRadiance linear = collectRadiance(floor.texels, progress, {}, &linearization);
    EXPECT_EQ(linear.isClipped, floor.radiance.isClipped);
    EXPECT_NEAR(linear.plain[floor.at({0.4f, 0.0f, 1.0f}, kUp)].g, 1.2f, 1e-2f);
    for (const ClippedPatch& patch : linear.clipped)
        EXPECT_NEAR(patch.radiance.g, linear.whiteOf(patch.surfel).g, 1e-6f);
}

// Normals without a scan's noise lean across the edge of a lamp; what the lamp is cut by does not.
TEST(SurfelRadiance, PatchesFaceTheWayTheScanDid)
{
    Scan scan = scenes::square(2.0f, 200, halfBurntOut());
    const glm::vec3 leaning = glm::normalize(glm::vec3(0.2f, 1.0f, 0.0f));
    for (Mesh& mesh : scan.meshes) mesh.facings.assign(mesh.triangles.size(), leaning);
    const scenes::Surfaces floor(std::move(scan));
    ASSERT_FALSE(floor.radiance.clipped.empty());
    for (const ClippedPatch& patch : floor.radiance.clipped)
        EXPECT_NEAR(glm::distance(patch.normal, leaning), 0.0f, 1e-5f);
}

} // namespace relamp
