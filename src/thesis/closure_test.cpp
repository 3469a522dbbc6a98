#include "thesis/closure.h"

#include "base/radiometry.shared.h"
#include "scenes/scenes.h"
#include "thesis/direct.shared.h"

#include <cmath>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr glm::vec3 kAttenuation(0.0f, 0.0f, 1.0f);

Lights oneLamp(float intensity)
{
    Lights lights;
    lights.points.push_back({.position = {2.0f, 1.5f, 2.0f}, .intensity = glm::vec3(intensity)});
    return lights;
}

/// A grey room under the lamp, shaded as the thesis shades without bounces.
Scan litRoom()
{
    return scenes::room(glm::vec3(4.0f, 2.5f, 4.0f), 48, [](glm::vec3 p, glm::vec3 n) {
        const glm::vec3 toLamp = oneLamp(1.0f).points[0].position - p;
        return glm::vec3(0.5f * (0.1f + receivedFrom(toLamp, n, kAttenuation) / kPi));
    });
}

class ClosureTest : public testing::Test
{
protected:
    [[nodiscard]] Closure close(const ThesisShading& shading, const Lights& lights)
    {
        return closeLoop(texels, scene, collectLight(texels, {}, progress), lights, shading, 0.02f);
    }
    [[nodiscard]] ThesisShading shadingOf(const Lights& lights, bool bounces)
    {
        ThesisOptions parameters;
        parameters.attenuation = kAttenuation;
        parameters.useLpv = bounces;
        ThesisShading shading = solveThesis(texels, scene, lights, parameters, progress);
        shading.parameters.power = 1.0f;
        shading.ambient = glm::vec3(0.1f);
        return shading;
    }

    Progress progress;
    Scan scan = litRoom();
    Texels texels = rasterizeAtlas(scan, progress);
    RayScene scene{scan};
};

} // namespace

// Without bounces the second shading is the first: what was divided out is multiplied in again.
TEST_F(ClosureTest, IsExactWithoutBounces)
{
    const Lights lamp = oneLamp(1.0f);
    const Closure closure = close(shadingOf(lamp, false), lamp);
    EXPECT_LT(closure.rmsError, 1e-4f);
    EXPECT_GT(closure.rmsInput, 0.05f);
}

// Half the light explains half the texture, where albedo is held to 1: the error must show that.
TEST_F(ClosureTest, ShowsLightThatCannotExplainTheTexture)
{
    const Lights dim = oneLamp(0.02f);
    ThesisShading shading = shadingOf(dim, false);
    shading.ambient = glm::vec3(0.01f);
    EXPECT_GT(close(shading, dim).rmsError, 0.3f * close(shading, dim).rmsInput);
}

// With bounces the flattened texture and the recovered albedo differ, and so do their bounces.
TEST_F(ClosureTest, BouncesOffTheRecoveredAlbedo)
{
    const Lights lamp = oneLamp(1.0f);
    const Closure closure = close(shadingOf(lamp, true), lamp);
    EXPECT_GT(closure.rmsError, 1e-4f);
    EXPECT_LT(closure.rmsError, 0.5f * closure.rmsInput);
}

} // namespace relamp
