#pragma once

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

namespace relamp
{

/// A pinhole that looks into the room.
struct Camera
{
    glm::vec3 position{0.0f};             // world, m
    glm::vec3 forward{0.0f, 0.0f, -1.0f}; // unit, not vertical
    float fieldOfView = 1.3f;             // radians, across the width

    /// Unit direction through a point of the picture, (-1, -1) at the lower left, (1, 1) at the
    /// upper right; `aspect` is width / height.
    [[nodiscard]] glm::vec3 direction(float x, float y, float aspect) const
    {
        const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0.0f, 1.0f, 0.0f)));
        const glm::vec3 up = glm::cross(right, forward);
        const float reach = glm::tan(0.5f * fieldOfView);
        return glm::normalize(forward + x * reach * right + y * reach / aspect * up);
    }
};

} // namespace relamp
