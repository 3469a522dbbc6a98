#include "reach.h"

#include "camera_rig.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace
{

const relamp::Bounds kRoom{{0, 0, 0}, {4, 2.5f, 5}};

/// To the walls of kRoom from inside, past their backs from outside.
float toWall(glm::vec3 from, glm::vec3 direction)
{
    float distance = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0f) continue;
        const float wall = direction[axis] > 0.0f ? kRoom.high[axis] : kRoom.low[axis];
        const float away = (wall - from[axis]) / direction[axis];
        const glm::vec3 at = from + away * direction;
        bool isOnIt = away > 0.0f;
        for (int other = 0; other < 3; ++other)
            isOnIt &=
                other == axis || (at[other] >= kRoom.low[other] && at[other] <= kRoom.high[other]);
        if (isOnIt) distance = std::min(distance, away);
    }
    return distance;
}

/// Half-way up the room stands a pole.
float toPole(glm::vec3 from, glm::vec3 direction)
{
    const glm::vec2 way(direction.x, direction.z);
    const glm::vec2 to = glm::vec2(3.2f, 2.5f) - glm::vec2(from.x, from.z);
    const float along = glm::dot(to, way) / glm::dot(way, way);
    const bool isMet = along > 0.0f && glm::length(to - along * way) < 0.05f;
    return isMet ? along : std::numeric_limits<float>::infinity();
}

std::shared_ptr<Reach> room(bool hasPole = false)
{
    return std::make_shared<Reach>(
        [hasPole](glm::vec3 from, std::span<const glm::vec3> directions) {
            std::vector<float> distances;
            for (const glm::vec3 direction : directions)
                distances.push_back(
                    std::min(toWall(from, direction), hasPole ? toPole(from, direction) : 1e9f));
            return distances;
        },
        kRoom);
}

/// Near a corner, its place in the middle of the room.
CameraRig rigIn(bool hasPole = false)
{
    CameraRig rig;
    const glm::vec3 eye(0.3f, 1.6f, 0.4f);
    const glm::vec3 way = glm::vec3(2, 1.2f, 2.5f) - eye;
    rig.set({eye, glm::normalize(way), {0, 1, 0}, 1.2f}, glm::length(way));
    rig.setRoom(room(hasPole));
    return rig;
}

TEST(Reach, EndsALittleBeforeTheWalls)
{
    const auto reach = room();
    for (const glm::vec3 direction :
         {glm::vec3(1, 0, 0), glm::vec3(0, 0, -1), glm::vec3(0, 1, 0)}) {
        const float wall = toWall({2, 1.2f, 2.5f}, direction);

        const float most = reach->around({2, 1.2f, 2.5f}, direction);

        EXPECT_LT(most, wall - 0.05f);
        EXPECT_GT(most, 0.8f * wall);
    }
}

// A drag all around, up and down: in every step the eye is in the room, and moves no further than a
// hand expects.
TEST(Reach, OrbitStaysInTheRoomAndNeverLeaps)
{
    CameraRig camera = rigIn();
    const glm::vec3 place = camera.place();
    glm::vec3 before = camera.position();
    for (int step = 0; step < 1200; ++step) {
        const glm::vec3 looked = camera.forward();
        camera.turn({0.02f, 0.015f * std::sin(0.01f * static_cast<float>(step))});
        const float turned = glm::distance(looked, camera.forward());
        const glm::vec3 eye = camera.position();

        ASSERT_TRUE(kRoom.contains(eye - 0.05f) && kRoom.contains(eye + 0.05f)) << step;
        ASSERT_LT(glm::distance(eye, before), 7.0f * turned + 1e-4f) << step;
        ASSERT_LT(glm::distance(camera.place(), place), 1e-2f);
        before = eye;
    }
}

// What was shortened by a wall is as long as before where there is none.
TEST(Reach, EyeBacksOffAgainBehindAWall)
{
    CameraRig camera = rigIn();
    camera.turn({1e-3f, 0.0f});
    camera.turn({-1e-3f, 0.0f});
    const float far = glm::distance(camera.position(), camera.place());
    for (int i = 0; i < 90; ++i) camera.turn({0.01f, 0.0f});
    const float near = glm::distance(camera.position(), camera.place());
    for (int i = 0; i < 90; ++i) camera.turn({-0.01f, 0.0f});

    EXPECT_LT(near, 0.9f * far);
    EXPECT_NEAR(glm::distance(camera.position(), camera.place()), far, 0.25f);
}

TEST(Reach, APoleIsNoWall)
{
    const auto empty = room();
    const auto furnished = room(true);
    for (int i = 0; i < 126; ++i) {
        const float angle = 0.05f * static_cast<float>(i);
        const glm::vec3 direction(std::cos(angle), 0.0f, std::sin(angle));

        EXPECT_NEAR(furnished->around({2, 1.2f, 2.5f}, direction),
                    empty->around({2, 1.2f, 2.5f}, direction), 0.1f);
    }
}

TEST(Reach, WheelAndShiftStopBeforeTheWall)
{
    CameraRig camera = rigIn();
    for (int i = 0; i < 50; ++i) camera.approach(-1.0f);
    EXPECT_TRUE(kRoom.contains(camera.position()));
    for (int i = 0; i < 50; ++i) camera.pan({0.1f, 0.05f});
    EXPECT_TRUE(kRoom.contains(camera.position()));
    EXPECT_TRUE(kRoom.contains(camera.place()));
}

// A place on a wall, as a double click has it: the eye goes around before the wall.
TEST(Reach, PlaceOnAWallIsTurnedAroundBeforeIt)
{
    CameraRig camera = rigIn();
    camera.lookAt({4, 1.2f, 2.5f});
    for (int step = 0; step < 400; ++step) {
        camera.turn({0.02f, 0.0f});
        ASSERT_TRUE(kRoom.contains(camera.position())) << step;
    }
}

// The whole room is framed from outside, and turned around there; the wheel leads back into it.
TEST(Reach, FramingLeavesTheRoomAndTheWheelEntersIt)
{
    CameraRig camera = rigIn();
    camera.frame(kRoom, 1.6f);
    for (int i = 0; i < 100; ++i) {
        camera.turn({0.05f, 0.0f});
        ASSERT_FALSE(kRoom.contains(camera.position()));
    }
    for (int i = 0; i < 20; ++i) camera.approach(1.0f);
    ASSERT_TRUE(kRoom.contains(camera.position()));
    for (int i = 0; i < 40; ++i) camera.approach(-1.0f);
    EXPECT_TRUE(kRoom.contains(camera.position()));
}

} // namespace
