#include "camera_rig.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace
{

constexpr float kAspect = 1.6f;

CameraRig rig()
{
    CameraRig rig;
    rig.set({{1, 2, 3}, glm::normalize(glm::vec3(1, -0.5f, -2)), {0, 1, 0}, 1.2f}, 2.5f);
    return rig;
}

TEST(CameraRig, GivesBackTheCameraThatWasSet)
{
    const relamp::Camera camera = rig().camera();

    EXPECT_LT(glm::distance(camera.position, glm::vec3(1, 2, 3)), 1e-6f);
    EXPECT_LT(glm::distance(camera.forward, glm::normalize(glm::vec3(1, -0.5f, -2))), 1e-5f);
}

// Whatever lies on a sight must appear where the sight begins: matrix and rays are one camera.
TEST(CameraRig, SightsAndMatrixAgree)
{
    const CameraRig camera = rig();
    for (const glm::vec2 screen : {glm::vec2(0.1f, 0.2f), glm::vec2(0.9f, 0.7f)}) {
        const Sight sight = camera.sightThrough(screen, kAspect);

        const glm::vec3 seen = camera.onScreen(sight.origin + 3.0f * sight.direction, kAspect);

        EXPECT_LT(glm::distance(glm::vec2(seen), screen), 1e-4f);
    }
}

TEST(CameraRig, WhatIsToTheRightAndAboveAppearsThere)
{
    CameraRig camera;
    camera.set({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.2f}, 2.0f);

    const glm::vec3 seen = camera.onScreen({0.3f, 0.2f, -2}, kAspect);

    EXPECT_GT(seen.x, 0.5f);
    EXPECT_LT(seen.y, 0.5f);
    EXPECT_NEAR(seen.z, 2.0f, 1e-4f);
}

TEST(CameraRig, DepthLeadsBackToThePlace)
{
    const CameraRig camera = rig();
    const Sight sight = camera.sightThrough({0.3f, 0.6f}, kAspect);
    const glm::vec3 place = sight.origin + 4.0f * sight.direction;
    const glm::vec4 clip = camera.clipFromWorld(kAspect) * glm::vec4(place, 1.0f);

    EXPECT_LT(glm::distance(camera.pointAt({0.3f, 0.6f}, clip.z / clip.w, kAspect), place), 5e-3f);
}

TEST(CameraRig, OrbitKeepsItsPlaceAndWalkItsStand)
{
    CameraRig camera = rig();
    const glm::vec3 place = camera.place();
    camera.turn({0.7f, 0.2f});
    EXPECT_LT(glm::distance(camera.place(), place), 1e-4f);

    camera.mode = CameraRig::Mode::walk;
    const glm::vec3 stand = camera.position();
    camera.turn({0.7f, -0.4f});
    EXPECT_LT(glm::distance(camera.position(), stand), 1e-6f);
}

TEST(CameraRig, FramesAllCornersOfABox)
{
    CameraRig camera = rig();
    const relamp::Bounds box{{-1, 0, -2}, {3, 2.5f, 1}};

    camera.frame(box, kAspect);

    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 seen =
            camera.onScreen({(corner & 1) != 0 ? 3 : -1, (corner & 2) != 0 ? 2.5f : 0.0f,
                             (corner & 4) != 0 ? 1 : -2},
                            kAspect);
        EXPECT_GT(seen.z, 0.0f);
        EXPECT_THAT(seen.x, testing::AllOf(testing::Ge(0.0f), testing::Le(1.0f)));
        EXPECT_THAT(seen.y, testing::AllOf(testing::Ge(0.0f), testing::Le(1.0f)));
    }
}

TEST(CameraRig, WalksLevelHoweverItLooks)
{
    CameraRig camera = rig();
    camera.mode = CameraRig::Mode::walk;
    const float height = camera.position().y;

    camera.walk({0.5f, 0.0f, 1.0f});

    EXPECT_FLOAT_EQ(camera.position().y, height);
}

} // namespace
