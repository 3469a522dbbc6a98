#include "thesis/rsm.h"

#include "scenes/scenes.h"
#include "thesis/rsm.shared.h"

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr float kSphere = 12.5663706f;

class Rsm : public testing::Test
{
protected:
    [[nodiscard]] std::vector<BounceLight> maps(const PointLight& light, int resolution) const
    {
        return reflectiveShadowMaps(texels, scene, {&light, 1}, resolution);
    }
    static float fluxOf(const std::vector<BounceLight>& lights)
    {
        double sum = 0.0;
        for (const BounceLight& light : lights) sum += static_cast<double>(light.flux.g);
        return static_cast<float>(sum);
    }

    Scan scan = scenes::room({4.0f, 2.5f, 3.0f}, 64, scenes::plain(glm::vec3(0.5f)));
    Progress progress;
    Texels texels = rasterizeAtlas(scan, progress);
    RayScene scene{scan};
    PointLight lamp{.position = {1.0f, 2.0f, 1.0f}, .intensity = {1.0f, 3.0f, 0.0f}};
};

} // namespace

// Everything that the lamp sends out falls on some wall of a closed room: 4 pi times its intensity.
TEST_F(Rsm, ClosedRoomReceivesAllTheLightThereIs)
{
    EXPECT_NEAR(fluxOf(maps(lamp, 64)), kSphere * 3.0f, 1e-3f * kSphere * 3.0f);
}

TEST_F(Rsm, FluxDoesNotDependOnTheResolution)
{
    const float coarse = fluxOf(maps(lamp, 16));
    const float fine = fluxOf(maps(lamp, 128));
    EXPECT_NEAR(coarse, fine, 2e-3f * fine);
    EXPECT_EQ(maps(lamp, 16).size(), size_t{6 * 16 * 16});
}

// Irradiance that the pixels stand for, I cos / d^2, gathered over the floor by its texels.
TEST_F(Rsm, WallsReceiveTheirShareBySolidAngle)
{
    double onFloor = 0.0;
    for (const BounceLight& light : maps(lamp, 128))
        if (light.normal.y > 0.9f) onFloor += static_cast<double>(light.flux.g);
    double byTexels = 0.0;
    constexpr int kSteps = 400;
    for (int z = 0; z < kSteps; ++z)
        for (int x = 0; x < kSteps; ++x) {
            const double px = 4.0 * (x + 0.5) / kSteps - 1.0;
            const double pz = 3.0 * (z + 0.5) / kSteps - 1.0;
            const double squared = px * px + pz * pz + 4.0;
            byTexels +=
                3.0 * 2.0 / (squared * std::sqrt(squared)) * (4.0 * 3.0 / (kSteps * kSteps));
        }
    EXPECT_NEAR(onFloor / byTexels, 1.0, 0.01);
}

TEST_F(Rsm, PointsLieOnTheWallsAndFaceTheRoom)
{
    for (const BounceLight& light : maps(lamp, 16)) {
        const glm::vec3 inward = glm::vec3(2.0f, 1.25f, 1.5f) - light.position;
        EXPECT_GT(glm::dot(inward, light.normal), 0.0f);
        EXPECT_NEAR(glm::length(light.normal), 1.0f, 1e-5f);
    }
}

// Outside, the walls are only seen from behind, and behind there is no texture to pass light on.
TEST_F(Rsm, BackSidesReceiveNothing)
{
    const PointLight outside{.position = {10.0f, 1.0f, 1.0f}, .intensity = glm::vec3(1.0f)};
    EXPECT_TRUE(maps(outside, 32).empty());
}

TEST(RsmFormula, CubePixelsCoverTheSphere)
{
    for (const int n : {8, 33, 64}) {
        double sum = 0.0;
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                sum += static_cast<double>(cubePixelSolidAngle(
                    (2.0f * static_cast<float>(x) + 1.0f) / static_cast<float>(n) - 1.0f,
                    (2.0f * static_cast<float>(y) + 1.0f) / static_cast<float>(n) - 1.0f,
                    static_cast<float>(n)));
        EXPECT_NEAR(6.0 * sum / static_cast<double>(kSphere), 1.0, 0.01) << n;
    }
}

} // namespace relamp
