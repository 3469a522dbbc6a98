#include "gizmo.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace
{

constexpr float kArm = 90.0f;   // pixels
constexpr float kReach = 11.0f; // pixels around a handle

glm::vec3 axisOf(Handle handle)
{
    return {handle == Handle::x ? 1.0f : 0.0f, handle == Handle::y ? 1.0f : 0.0f,
            handle == Handle::z ? 1.0f : 0.0f};
}

glm::vec2 pixelOf(glm::vec3 point, const Gizmo::Eye& eye)
{
    return glm::vec2(eye.rig.onScreen(point, eye.pixels.x / eye.pixels.y)) * eye.pixels;
}

Sight sightOf(glm::vec2 pixel, const Gizmo::Eye& eye)
{
    return eye.rig.sightThrough(pixel / eye.pixels, eye.pixels.x / eye.pixels.y);
}

float distanceToSegment(glm::vec2 p, glm::vec2 a, glm::vec2 b)
{
    const glm::vec2 way = b - a;
    const float along =
        std::clamp(glm::dot(p - a, way) / std::max(glm::dot(way, way), 1e-6f), 0.0f, 1.0f);
    return glm::length(p - a - along * way);
}

} // namespace

std::optional<float> nearestAlong(const Sight& sight, glm::vec3 origin, glm::vec3 axis)
{
    const glm::vec3 between = origin - sight.origin;
    const float alike = glm::dot(axis, sight.direction);
    const float apart = 1.0f - alike * alike;
    if (apart < 1e-4f) return std::nullopt;
    return (alike * glm::dot(sight.direction, between) - glm::dot(axis, between)) / apart;
}

std::optional<glm::vec3> meetsPlane(const Sight& sight, glm::vec3 point, glm::vec3 normal)
{
    const float facing = glm::dot(sight.direction, normal);
    if (std::abs(facing) < 1e-4f) return std::nullopt;
    const float away = glm::dot(point - sight.origin, normal) / facing;
    if (away <= 0.0f) return std::nullopt;
    return sight.origin + away * sight.direction;
}

float Gizmo::armOf(const Aimed& light, const Eye& eye)
{
    const float aspect = eye.pixels.x / eye.pixels.y;
    const float away = std::max(eye.rig.onScreen(light.position, aspect).z, 0.05f);
    const glm::vec2 beside =
        glm::vec2(eye.rig.onScreen(eye.rig.position() + away * eye.rig.forward() + eye.rig.right(),
                                   aspect)) -
        0.5f;
    return kArm / std::max(std::abs(beside.x) * eye.pixels.x, 1.0f);
}

glm::vec3 Gizmo::tipOf(Handle handle, const Aimed& light, const Eye& eye)
{
    if (handle == Handle::centre) return light.position;
    const float arm = armOf(light, eye);
    if (handle == Handle::aim) return light.position + 1.5f * arm * light.direction;
    return light.position + arm * axisOf(handle);
}

Handle Gizmo::under(glm::vec2 pixel, const Aimed& light, const Eye& eye)
{
    const float aspect = eye.pixels.x / eye.pixels.y;
    if (eye.rig.onScreen(light.position, aspect).z <= 0.0f) return Handle::none;
    const auto near = [&](Handle handle) {
        return glm::length(pixel - pixelOf(tipOf(handle, light, eye), eye)) < kReach;
    };
    if (light.aims && near(Handle::aim)) return Handle::aim;
    if (near(Handle::centre)) return Handle::centre;
    for (const Handle axis : {Handle::x, Handle::y, Handle::z})
        if (distanceToSegment(pixel, pixelOf(light.position, eye),
                              pixelOf(tipOf(axis, light, eye), eye)) < 0.6f * kReach ||
            near(axis))
            return axis;
    return Handle::none;
}

void Gizmo::grab(Handle handle, glm::vec2 pixel, const Aimed& light, const Eye& eye)
{
    held_ = handle;
    start_ = light;
    plane_ = tipOf(handle, light, eye);
    offset_ = glm::vec3(0.0f);
    if (const auto at = grip(pixel, eye)) offset_ = plane_ - *at;
}

std::optional<glm::vec3> Gizmo::grip(glm::vec2 pixel, const Eye& eye) const
{
    const Sight sight = sightOf(pixel, eye);
    if (held_ == Handle::centre || held_ == Handle::aim)
        return meetsPlane(sight, plane_, eye.rig.forward());
    const glm::vec3 axis = axisOf(held_);
    const auto along = nearestAlong(sight, start_.position, axis);
    if (!along) return std::nullopt;
    return start_.position + *along * axis;
}

Aimed Gizmo::dragged(glm::vec2 pixel, const Eye& eye) const
{
    const auto at = grip(pixel, eye);
    if (!at || held_ == Handle::none) return start_;
    Aimed light = start_;
    const glm::vec3 moved = *at + offset_;
    if (held_ == Handle::aim) {
        const glm::vec3 way = moved - start_.position;
        if (glm::dot(way, way) > 1e-8f) light.direction = glm::normalize(way);
    } else {
        light.position += glm::clamp(moved - plane_, -20.0f, 20.0f);
    }
    return light;
}
