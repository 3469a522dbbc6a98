#include "camera_rig.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace
{

constexpr float kNear = 0.02f; // m
constexpr float kFar = 300.0f;
constexpr float kSteepest = 1.55f; // rad; straight up there is no right
constexpr float kNearest = 0.1f;   // m, to what it turns around
constexpr float kFarthest = 200.0f;
constexpr float kBefore = 0.05f;               // m, of a surface that it turns around
constexpr float kClear = 0.1f;                 // m, between the eye and what it is shifted to
constexpr float kGlide = 2.0f * Reach::kSlope; // m a radian, at most; more than the room asks for
const glm::vec3 kUp(0.0f, 1.0f, 0.0f);

} // namespace

void CameraRig::setRoom(std::shared_ptr<Reach> room)
{
    room_ = std::move(room);
    knowsPlace_ = isInside_ = false;
}

/// A place behind a wall is none to turn around: it is brought before it.
void CameraRig::findPlace()
{
    if (knowsPlace_ || !room_) return;
    knowsPlace_ = true;
    const float ahead = room_->ahead(position_, forward()) - kBefore;
    distance_ = wanted_ = std::clamp(std::min(distance_, ahead), kNearest, kFarthest);
    isInside_ = room_->sees(place(), position_);
}

/// How far the eye may be from the place, m.
float CameraRig::limit() const
{
    return isInside_ ? std::min(wanted_, room_->around(place(), -forward())) : wanted_;
}

void CameraRig::set(const relamp::Camera& camera, float distance)
{
    position_ = camera.position;
    yaw_ = std::atan2(camera.forward.x, -camera.forward.z);
    pitch_ =
        std::clamp(std::asin(std::clamp(camera.forward.y, -1.0f, 1.0f)), -kSteepest, kSteepest);
    distance_ = wanted_ = std::clamp(distance, kNearest, kFarthest);
    angle_ = camera.fieldOfView;
    across_ = camera.across;
    knowsPlace_ = isInside_ = false;
}

void CameraRig::frame(const relamp::Bounds& box, float aspect)
{
    const float radius = std::max(0.5f * glm::length(box.extent()), 0.05f);
    const float up = heightAngle(aspect);
    const float narrow = std::min(up, 2.0f * std::atan(aspect * std::tan(0.5f * up)));
    distance_ = wanted_ = std::clamp(radius / std::sin(0.5f * narrow), kNearest, kFarthest);
    position_ = box.centre() - distance_ * forward();
    knowsPlace_ = true;
    isInside_ = false;
}

void CameraRig::comeInside()
{
    if (!room_) return;
    const glm::vec3 around = place();
    isInside_ = true;
    distance_ = limit();
    position_ = around - distance_ * forward();
}

void CameraRig::lookAt(glm::vec3 place)
{
    const glm::vec3 way = place - position_;
    const float distance = glm::length(way);
    if (distance < kNearest) return;
    set({position_, way / distance, kUp, angle_, across_}, distance);
}

void CameraRig::turn(glm::vec2 by)
{
    if (mode == Mode::orbit) findPlace();
    const glm::vec3 around = place();
    const glm::vec3 before = forward();
    yaw_ = std::remainder(yaw_ + by.x, 2.0f * glm::pi<float>());
    pitch_ = std::clamp(pitch_ + by.y, -kSteepest, kSteepest);
    if (mode == Mode::walk) {
        knowsPlace_ = false;
        return;
    }
    position_ = around - distance_ * forward();
    // Never at a leap: an eye that stands too near to a wall to begin with glides away from it.
    const float most = kGlide * glm::distance(before, forward());
    distance_ = std::clamp(limit(), distance_ - most, distance_ + most);
    position_ = around - distance_ * forward();
}

void CameraRig::pan(glm::vec2 by)
{
    const float height = 2.0f * distance_ * std::tan(0.5f * heightAngle(16.0f / 9.0f));
    if (mode == Mode::orbit) findPlace();
    shift(height * by.x * right());
    shift(height * by.y * glm::cross(right(), forward()));
}

/// Eye and place, up to a wall.
void CameraRig::shift(glm::vec3 by)
{
    const float length = glm::length(by);
    if (length <= 0.0f) return;
    float allowed = length;
    if (mode == Mode::orbit && isInside_)
        for (const glm::vec3& from : {position_, place()})
            allowed = std::min(allowed, room_->ahead(from, by / length) - kClear);
    position_ += std::max(allowed, 0.0f) / length * by;
}

void CameraRig::approach(float steps)
{
    if (mode == Mode::walk) return walk({0.0f, 0.0f, 0.15f * steps});
    findPlace();
    const glm::vec3 around = place();
    wanted_ = std::clamp(distance_ * std::pow(0.9f, steps), kNearest, kFarthest);
    // Before a wall it stays where it is, which may be nearer to it than it would come.
    distance_ = std::min(wanted_, std::max(limit(), distance_));
    if (isInside_) wanted_ = distance_;
    position_ = around - distance_ * forward();
    isInside_ = isInside_ || (room_ && room_->sees(around, position_) &&
                              room_->around(around, -forward()) >= distance_);
}

void CameraRig::walk(glm::vec3 by)
{
    const glm::vec3 ahead(std::sin(yaw_), 0.0f, -std::cos(yaw_));
    position_ += by.x * right() + by.y * kUp + by.z * ahead;
    knowsPlace_ = false;
}

relamp::Camera CameraRig::camera() const
{
    return {position_, forward(), glm::normalize(glm::cross(right(), forward())), angle_, across_};
}

glm::vec3 CameraRig::forward() const
{
    return {std::sin(yaw_) * std::cos(pitch_), std::sin(pitch_),
            -std::cos(yaw_) * std::cos(pitch_)};
}

glm::vec3 CameraRig::right() const
{
    return {std::cos(yaw_), 0.0f, std::sin(yaw_)};
}

float CameraRig::heightAngle(float aspect) const
{
    return across_ == relamp::Across::height ? angle_
                                             : 2.0f * std::atan(std::tan(0.5f * angle_) / aspect);
}

glm::mat4 CameraRig::clipFromWorld(float aspect) const
{
    glm::mat4 clip = glm::perspectiveRH_ZO(heightAngle(aspect), aspect, kNear, kFar);
    clip[1] *= -1.0f; // Vulkan's y points down
    return clip * glm::lookAt(position_, position_ + forward(), kUp);
}

Sight CameraRig::sightThrough(glm::vec2 screen, float aspect) const
{
    const float high = std::tan(0.5f * heightAngle(aspect));
    const glm::vec2 at = 2.0f * screen - 1.0f;
    return {position_, glm::normalize(forward() + at.x * high * aspect * right() -
                                      at.y * high * glm::cross(right(), forward()))};
}

glm::vec3 CameraRig::onScreen(glm::vec3 point, float aspect) const
{
    const glm::vec4 clip = clipFromWorld(aspect) * glm::vec4(point, 1.0f);
    const float w = std::abs(clip.w) > 1e-6f ? clip.w : 1e-6f;
    return {0.5f + 0.5f * clip.x / w, 0.5f + 0.5f * clip.y / w, clip.w};
}

glm::vec3 CameraRig::pointAt(glm::vec2 screen, float depth, float aspect) const
{
    const float away = kNear * kFar / (kFar - std::clamp(depth, 0.0f, 1.0f) * (kFar - kNear));
    const Sight sight = sightThrough(screen, aspect);
    return sight.origin + away / glm::dot(sight.direction, forward()) * sight.direction;
}
