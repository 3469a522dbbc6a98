#pragma once

#include "relamp/delight.h"
#include "scan/rays.h"
#include "scan/texels.h"
#include "thesis/emitters.h"
#include "thesis/thesis_shading.h"

#include <vector>

namespace relamp
{

/// Closes the loop: shades the recovered albedo with the recovered lights, its own bounces and not
/// the texture's, and compares that with the texture, surfel by surfel, weighted by area.
Closure closeLoop(const Texels& texels, const RayScene& scene, const SurfelLight& light,
                  const Lights& lights, const ThesisShading& shading, float darkest);

/// Shading at every surfel.
std::vector<glm::vec3> shadingOfSurfels(const Surfels& surfels, const ThesisShading& shading);

} // namespace relamp
