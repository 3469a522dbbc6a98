#pragma once

#include "lights/surfel_radiance.h"
#include "solve/found_room.h"

#include <span>

#include <glm/vec3.hpp>

namespace relamp
{

/// Scales the shading of a room so that what a person called white has the albedo of white paper,
/// in the mean of its logarithms. `irradiance`: of surfels, with all that corrects it. Nothing is
/// done where nobody did, or lights are given.
void scaleToWhite(std::span<const glm::vec3> irradiance, FoundRoom& room);

} // namespace relamp
