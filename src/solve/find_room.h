#pragma once

#include "relamp/delight.h"
#include "relamp/progress.h"
#include "scan/rays.h"
#include "scan/texels.h"
#include "solve/found_room.h"

namespace relamp
{

/// As fine as light changes on walls; coarse for a draft. separateEnclosed has to follow.
SurfelOptions surfelsOf(const GatherOptions& options);

/// Finds the lamps and their radiances by what they do to the walls, and the sun by the patch that
/// it throws; where something glows that is not burnt out, it is a lamp, and all is found again.
/// Where the options name lights, nothing is searched and it is these: the fixtures of their file
/// on the surfaces that have their numbers. All lamps have been looked at. `before`: the same
/// texels under other options, or null; where as many rays are wanted, what they met is taken from
/// there.
FoundRoom findRoom(const Texels& texels, const RayScene& scene, const DelightOptions& options,
                   Progress& progress, const FoundRoom* before = nullptr);

} // namespace relamp
