#pragma once

#include "lights/surfel_radiance.h"
#include "relamp/progress.h"
#include "scan/rays.h"
#include "scan/texels.h"
#include "shading/texel_shading.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Which texels count that the edge of a thing crosses: those whose middle lies under it, where the
/// texture tells how much of them is open (withRims); or none, where rays to lights have to tell.
enum class BuriedWhen { middle, whole };

/// Makes texels that something stands on or lies on surfels of their own: every ray from them meets
/// a surface from behind, as inside a solid. Where a rug lies on a floor, that floor would else
/// send and get the mean of light and darkness. A modelled room has many, a scanned one hardly any.
/// None where most are, for then the scan is inside out.
void separateBuried(Texels& texels, const RayScene& scene, Progress& progress,
                    BuriedWhen when = BuriedWhen::middle);

/// The shading, with some of the light around on buried texels at the rim of what lies there: such
/// a texel is part open, and shows more than the light under a thing can make of the paint around.
/// `irradiance`: found, one a surfel.
TexelShading withRims(const Texels& texels, TexelShading shade, const SurfelRadiance& radiance,
                      std::span<const glm::vec3> irradiance);

} // namespace relamp
