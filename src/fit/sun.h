#pragma once

#include "fit/lamps.h"
#include "relamp/lights.h"
#include "scan/rays.h"
#include "scan/split_surfels.h"
#include "scan/texels.h"
#include "shading/lit_sides.h"

#include <optional>
#include <vector>

namespace relamp
{

/// The sun as a piece of lamp far beyond the scan, a disc of its angular size. Its radiance is
/// sunRadiance(sun).
std::vector<ClippedPatch> sunDisc(const Sun& sun, const Scan& scan);
glm::vec3 sunRadiance(const Sun& sun);

/// Looks for a sun that explains a patch brighter than the lamps make it.
///
/// There is one direction for each patch at most, and many patches have none: where the whole patch
/// sees out through holes and panes, and what lies around it does not. `sides` is the room's light
/// without a sun, `outside` comes from sceneWithoutPanes. None is found where no direction fits
/// well.
std::optional<Sun> findSun(const Texels& texels, const RayScene& outside, const HitLists& hits,
                           const SurfelRadiance& radiance, const LitSides& sides,
                           const FoundLamps& found);

/// Marks texels that the sun does not reach though nothing may stand in its way: sunlit they would
/// be blacker than any paint, and without it they have an albedo. A reconstructed window is a
/// little wider than it was, and what stands outside is not in the scan. `sides` is the light
/// without the sun; `onSides`, what each hit list sees of the sun, loses as much.
TexelMarks markShade(const Sun& sun, const Texels& texels, const SurfelRadiance& radiance,
                     const LitSides& sides, std::span<AreaSample> onSides);

/// Whether most of a lamp's surface sees the sun: it is a burnt-out patch of sunlight.
bool isSunlit(const RayScene& outside, const Sun& sun, const FoundLamp& lamp);

} // namespace relamp
