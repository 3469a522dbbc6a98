#pragma once

#include "relamp/progress.h"
#include "scan/rays.h"
#include "scan/texels.h"
#include "shading/hit_lists.h"

namespace relamp
{

/// Lets as many rays of every front's list leave through each upright opening as it sees of that,
/// by rays to all of it: of a list's own few happen to leave by a window, and their number is
/// noise. Only for the sum of light: which way a ray of a list leaves is told no more.
void evenOpenings(const Texels& texels, const RayScene& scene, HitLists& hits, Progress& progress);

} // namespace relamp
