#pragma once

#include "relamp/delight.h"
#include "shading/lit_sides.h"

namespace relamp
{

/// Closes the loop of the gather solver: light from the lamps bounces off the recovered albedo
/// alone, the texture's own light forgotten, and is compared with the texture, surfel by surfel,
/// weighted by area.
Closure closeLoop(const HitLists& hits, const SurfelRadiance& radiance, const LitSides& sides,
                  glm::vec3 ambient);

} // namespace relamp
