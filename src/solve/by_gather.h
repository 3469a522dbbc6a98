#pragma once

#include "scan/rays.h"
#include "scan/texels.h"
#include "solve/solution.h"

namespace relamp
{

/// The default: lamps are what the walls say they are, direct light has area and shadows, and the
/// scan itself is the light field that bounce light is gathered from.
Solution solveByGather(const Texels& texels, const RayScene& scene, const DelightOptions& options,
                       Progress& progress);

} // namespace relamp
