#pragma once

#include "relamp/delight.h"
#include "shading/lit_sides.h"

#include <span>

namespace relamp
{

/// Closes the loop of the gather solver: light from the lamps bounces off the recovered albedo
/// alone, the texture's own light forgotten, and is compared with the texture, surfel by surfel,
/// weighted by area.
Closure closeLoop(const HitLists& hits, const SurfelRadiance& radiance, const LitSides& sides);

/// How far `again`, what surfels send out by the recovered albedo and lights, is from the texture,
/// weighted by area.
Closure closureOf(const SurfelRadiance& radiance, std::span<const glm::vec3> again);

} // namespace relamp
