#pragma once

#include "fit/glowing.h"
#include "lights/surfel_radiance.h"
#include "scan/surfels.h"

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// The bright pieces of surface at `places` (m) that a person calls lamps, of those that are hardly
/// burnt out: a curtain before a window, a shade. Each goes from the brightest spot within
/// kPointedAt to where its rim falls off the most, before it shows 1 / kUnsureLight as much. What
/// faces up is left out, for a patch of sun lies there, unless that spot does. What is mostly burnt
/// out is a candidate as it is.
std::vector<Glowing> toldLamps(std::span<const glm::vec3> places, const Surfels& surfels,
                               const SurfelRadiance& radiance);

} // namespace relamp
