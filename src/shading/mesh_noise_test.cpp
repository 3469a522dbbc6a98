#include "shading/mesh_noise.shared.h"

#include "scenes/axes.h"
#include "scenes/surfaces.h"
#include "shading/lamp_patches.h"

#include <cmath>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::kDown;
using scenes::kUp;

/// A panel in a ceiling at 2.5 m, and its light on a place.
struct CeilingPanel
{
    AreaLight light = scenes::lightOf({{-0.025f, 2.5f, -0.025f}, {0.05f, 0, 0}, {0, 0, 0.05f}}, 1);

    [[nodiscard]] float openAt(glm::vec3 place, glm::vec3 normal, Geometry geometry) const
    {
        TexelBlock block;
        scenes::addTexel(block, place, normal);
        float irradiance[TexelBlock::kPadded];
        openIrradiance(block, LampPatches(light), geometry, irradiance);
        return irradiance[0];
    }
};

} // namespace

// A scan is some degrees and a centimetre off: a ceiling that bends to a panel in it gets no light.
TEST(MeshNoise, DoesNotLightACeilingByAPanelInIt)
{
    const CeilingPanel panel;
    const float tilt = 0.035f;                                 // 2 degrees
    const glm::vec3 bent(-std::sin(tilt), -std::cos(tilt), 0); // towards the panel
    for (const float distance : {0.1f, 0.3f, 1.0f, 4.0f}) {
        const glm::vec3 place(distance, 2.495f, 0); // and half a centimetre below
        EXPECT_EQ(panel.openAt(place, bent, Geometry::scanned), 0.0f);
        EXPECT_GT(panel.openAt(place, {-1, 0, 0}, Geometry::scanned), 0.0f);
    }
    EXPECT_GT(panel.openAt({1.0f, 2.495f, 0}, bent, Geometry::exact), 0.0f);
    // what lies deeper under it faces it
    EXPECT_GT(panel.openAt({0.3f, 2.3f, 0}, {-0.6f, -0.8f, 0}, Geometry::scanned), 0.0f);
}

// Walls and floor get all the light of a ceiling.
TEST(MeshNoise, IsNothingWhereTwoDoNotFaceAlike)
{
    const CeilingPanel panel;
    for (const glm::vec3 place : {glm::vec3(1, 0, 0), glm::vec3(0.1f, 2.4f, 0)})
        for (const glm::vec3 normal : {kUp, glm::vec3(-1, 0, 0), glm::vec3(-0.8f, 0.6f, 0)})
            EXPECT_FLOAT_EQ(panel.openAt(place, normal, Geometry::scanned),
                            panel.openAt(place, normal, Geometry::exact));
}

TEST(MeshNoise, CountsTheMoreTheMoreTwoFaceAlike)
{
    const glm::vec3 toPatch(1.0f, 0.1f, 0.0f);
    float former = 1.0f;
    for (const float tilt : {1.2f, 0.9f, 0.6f, 0.3f, 0.15f}) { // rad, towards the panel
        const glm::vec3 normal(std::sin(tilt), -std::cos(tilt), 0.0f);
        const float share = shareBeyondMeshNoise(toPatch, normal, kDown);
        EXPECT_GE(share, 0.0f);
        EXPECT_LE(share, former);
        former = share;
    }
    EXPECT_LT(former, 0.2f);
}

} // namespace relamp
