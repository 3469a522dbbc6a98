#pragma once

#include "scan/rays.h"
#include "scan/texels.h"
#include "solve/solution.h"

namespace relamp
{

/// Choi's system: median cut of what is burnt out, point lights without shadows, bounce light by
/// RSM and LPV, ambient light; dials that are left open follow from the scan.
Solution solveByThesis(const Texels& texels, const RayScene& scene, const DelightOptions& options,
                       Progress& progress);

} // namespace relamp
