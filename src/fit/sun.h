#pragma once

#include "base/radiometry.shared.h"
#include "lights/surfel_radiance.h"
#include "relamp/lights.h"
#include "scan/rays.h"
#include "scan/split_surfels.h"
#include "scan/texels.h"
#include "shading/lit_sides.h"

#include <optional>
#include <span>
#include <vector>

namespace relamp
{

/// Of the disc, sr.
constexpr float sunSolidAngle()
{
    return kPi * kSunHalfAngle * kSunHalfAngle;
}

/// The sun as a piece of lamp far beyond the scan, a disc of its angular size. Its radiance is
/// sunRadiance(sun).
std::vector<ClippedPatch> sunDisc(const Sun& sun, const Scan& scan);
glm::vec3 sunRadiance(const Sun& sun);

/// The way from a place of the scan to the sun; none where the surface looks away.
std::optional<Ray> rayToSun(glm::vec3 place, glm::vec3 normal, glm::vec3 towards);

/// Marks texels that the sun does not reach though nothing may stand in its way: sunlit they would
/// be blacker than any paint, and without it they have an albedo. A reconstructed window is a
/// little wider than it was, and what stands outside is not in the scan. `sides` is the light
/// without the sun; `onSides`, what each hit list sees of the sun, loses as much.
TexelMarks markShade(const Sun& sun, const Texels& texels, const SurfelRadiance& radiance,
                     const LitSides& sides, LampSight& onSides);

} // namespace relamp
