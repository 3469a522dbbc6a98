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

/// Whether a way, straight or with one corner, leads from one place of a plane to another at some
/// height over it, from 10 cm, which leads under tables, to 1.8 m, which leads over cupboards.
/// Where a wall is between they are of two rooms; what hangs over one of them, or stands on it,
/// does not part them.
///
/// Doors that stand open make one room of two, as far as one place is seen from the other.
bool areInOneRoomOfPlane(const RayScene& scene, const FacingPlace& p, const FacingPlace& q);

/// The same of any two places, and that what is over them is their own room, and no other storey.
bool areInOneRoom(const RayScene& scene, const FacingPlace& p, const FacingPlace& q);

} // namespace relamp
