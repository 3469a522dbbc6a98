#pragma once

#include <glm/vec3.hpp>

namespace relamp
{

enum class Across { width, height };

/// A pinhole that looks into the room.
struct Camera
{
    glm::vec3 position{0.0f};             // world, m
    glm::vec3 forward{0.0f, 0.0f, -1.0f}; // unit
    glm::vec3 up{0.0f, 1.0f, 0.0f};       // unit, not along `forward`; shows upwards in the picture
    float fieldOfView = 1.3f;             // rad, 0..pi
    Across across = Across::width;        // what `fieldOfView` is measured across
};

} // namespace relamp
