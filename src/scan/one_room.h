#pragma once

#include "scan/rays.h"

#include <glm/vec3.hpp>

namespace relamp
{

/// A place on a surface and the way that it faces.
struct FacingPlace
{
    glm::vec3 position{0.0f}; // world
    glm::vec3 normal{0.0f};   // unit
};

/// Whether nothing stands between two places at some height over both, from 10 cm, which leads
/// under tables, to 1 m, which leads past cupboards: where a wall does, they are of two rooms.
///
/// Doors that stand open make one room of two, as far as one place is seen from the other.
bool areInOneRoom(const RayScene& scene, const FacingPlace& p, const FacingPlace& q);

} // namespace relamp
