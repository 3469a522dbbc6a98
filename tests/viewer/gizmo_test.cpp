#include "gizmo.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace
{

/// A light two metres ahead of the camera.
struct Scene
{
    CameraRig rig;
    Gizmo::Eye eye{rig, {800, 600}};
    Aimed light{{0, 0, -2}, {0, -1, 0}, true};

    Scene() { rig.set({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.2f}, 2.0f); }
    [[nodiscard]] glm::vec2 pixelOf(glm::vec3 point) const
    {
        return glm::vec2(rig.onScreen(point, 800.0f / 600.0f)) * eye.pixels;
    }
};

TEST(NearestAlong, IsWhereTheSightPassesTheLine)
{
    const auto at = nearestAlong({{1.5f, 0, 5}, {0, 0, -1}}, {0, 0.2f, 0}, {1, 0, 0});

    ASSERT_TRUE(at);
    EXPECT_NEAR(*at, 1.5f, 1e-5f);
    EXPECT_FALSE(nearestAlong({{0, 0, 5}, {1, 0, 0}}, {0, 0, 0}, {1, 0, 0}));
}

TEST(MeetsPlane, OnlyAhead)
{
    const auto at = meetsPlane({{1, 2, 3}, {0, 0, -1}}, {0, 0, -4}, {0, 0, 1});

    ASSERT_TRUE(at);
    EXPECT_LT(glm::distance(*at, glm::vec3(1, 2, -4)), 1e-5f);
    EXPECT_FALSE(meetsPlane({{1, 2, 3}, {0, 0, 1}}, {0, 0, -4}, {0, 0, 1}));
}

TEST(Gizmo, HandlesAreUnderTheirTips)
{
    const Scene scene;
    for (const Handle handle : {Handle::x, Handle::y, Handle::centre, Handle::aim}) {
        const glm::vec2 pixel = scene.pixelOf(Gizmo::tipOf(handle, scene.light, scene.eye));
        EXPECT_EQ(Gizmo::under(pixel, scene.light, scene.eye), handle);
    }
    EXPECT_EQ(Gizmo::under({5, 5}, scene.light, scene.eye), Handle::none);
}

TEST(Gizmo, AnAxisMovesAlongItselfAlone)
{
    const Scene scene;
    Gizmo gizmo;
    const glm::vec2 tip = scene.pixelOf(Gizmo::tipOf(Handle::x, scene.light, scene.eye));
    gizmo.grab(Handle::x, tip, scene.light, scene.eye);

    const Aimed moved = gizmo.dragged(tip + glm::vec2(60, 40), scene.eye);

    EXPECT_GT(moved.position.x, 0.1f);
    EXPECT_FLOAT_EQ(moved.position.y, 0.0f);
    EXPECT_FLOAT_EQ(moved.position.z, -2.0f);
}

// What the mouse holds stays under the mouse.
TEST(Gizmo, TheMiddleFollowsTheMouse)
{
    const Scene scene;
    Gizmo gizmo;
    const glm::vec2 from = scene.pixelOf(scene.light.position);
    gizmo.grab(Handle::centre, from, scene.light, scene.eye);

    const Aimed moved = gizmo.dragged(from + glm::vec2(70, -30), scene.eye);

    EXPECT_LT(glm::distance(scene.pixelOf(moved.position), from + glm::vec2(70, -30)), 0.1f);
}

TEST(Gizmo, TheTipTurnsAndDoesNotMove)
{
    const Scene scene;
    Gizmo gizmo;
    const glm::vec2 tip = scene.pixelOf(Gizmo::tipOf(Handle::aim, scene.light, scene.eye));
    gizmo.grab(Handle::aim, tip, scene.light, scene.eye);

    const Aimed turned = gizmo.dragged(scene.pixelOf({1, 0, -2}), scene.eye);

    EXPECT_LT(glm::distance(turned.direction, glm::vec3(1, 0, 0)), 1e-3f);
    EXPECT_EQ(turned.position, scene.light.position);
}

} // namespace
