#pragma once

#include "lights/surfel_radiance.h"
#include "scan/rays.h"
#include "scan/texels.h"

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Where a sun may stand, the likeliest first, by geometry alone.
struct SunDirections
{
    std::vector<glm::vec3> towards; // unit, above the horizon
    size_t tried = 0;               // how many were looked at to find these
};

/// Directions in which a patch that is brighter than its light allows sees out of the room, and
/// what else is there does not. A lamp, a highlight or a poster rarely has one, and whoever fits
/// the sun must ask what the many tries are worth.
///
/// `albedo`: one a surfel, of luminance, that it would have in the light that is known; above 1
/// where that is too little. `outside` comes from sceneWithoutPanes.
SunDirections sunDirections(const Texels& texels, const RayScene& outside,
                            const SurfelRadiance& radiance, std::span<const float> albedo);

} // namespace relamp
