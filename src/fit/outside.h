#pragma once

#include "fit/lamps.h"
#include "lights/surfel_radiance.h"
#include "scan/rays.h"
#include "scan/texels.h"

namespace relamp
{

/// The scan's surface as the sun sees it: lamps that stand upright, as window panes do, let it
/// through.
RayScene sceneWithoutPanes(const RayScene& scene, const Texels& texels,
                           const SurfelRadiance& radiance, const FoundLamps& found);

} // namespace relamp
