#include "fit/stray.h"

#include "scenes/scenes.h"
#include "scenes/surfaces.h"

#include <cmath>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

/// Shading of a floor that is dark on one side and lit on the other.
float shadingAt(float x)
{
    return 0.05f * std::exp2(2.2f * x); // 0.05 .. 1.06 over 2 m
}

/// A floor of red and blue stripes under that shading.
Scan floorUnderIt()
{
    return scenes::square(2.0f, 128, [](glm::vec3 p, glm::vec3) {
        const bool isRed = std::fmod(p.z, 0.5f) < 0.25f;
        const glm::vec3 albedo = isRed ? glm::vec3(0.8f, 0.4f, 0.2f) : glm::vec3(0.2f, 0.4f, 0.8f);
        return albedo * shadingAt(p.x);
    });
}

/// What a solver says: the true shading and some more.
TexelShading tooBrightBy(float stray)
{
    return [=](size_t, size_t, const TexelBlock& block, ShadingBlock& out) {
        for (size_t i = 0; i < block.count; ++i) {
            out.direct.r[i] = out.direct.g[i] = out.direct.b[i] = shadingAt(block.x[i]);
            out.indirect.r[i] = out.indirect.g[i] = out.indirect.b[i] = stray;
        }
    };
}

} // namespace

TEST(Stray, ShadingThatIsRightIsKept)
{
    const scenes::Surfaces floor(floorUnderIt());
    const StrayLight stray = fitStray(floor.texels, floor.radiance, tooBrightBy(0.0f));
    for (const float shading : {0.05f, 0.1f, 0.3f, 1.0f})
        EXPECT_NEAR(stray.kept(shading), 1.0f, 0.03f) << shading;
}

// 0.05 too much everywhere doubles the darkest place and hardly shows in the light. The middle
// place, 0.28 for 0.23, is what the others are compared with.
TEST(Stray, DarkPlacesThatAreTooBrightAreDarkened)
{
    const scenes::Surfaces floor(floorUnderIt());
    const StrayLight stray = fitStray(floor.texels, floor.radiance, tooBrightBy(0.05f));
    const float middle = 0.28f / 0.23f;
    EXPECT_NEAR(stray.kept(0.1f) * 0.1f, 0.05f * middle, 0.01f);
    EXPECT_NEAR(stray.kept(0.15f) * 0.15f, 0.1f * middle, 0.01f);
    EXPECT_EQ(stray.kept(1.0f), 1.0f);
}

TEST(Stray, DirectAndIndirectAreDarkenedAlike)
{
    StrayLight stray({1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f});
    TexelBlock block;
    scenes::addTexel(block, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
    ShadingBlock out;
    withoutStray(tooBrightBy(0.2f), stray)(0, 0, block, out);
    EXPECT_NEAR(out.direct.g[0], 0.5f * shadingAt(1.0f), 1e-4f);
    EXPECT_NEAR(out.indirect.g[0], 0.1f, 1e-4f);
}

} // namespace relamp
