#pragma once

#include "lights/surfel_radiance.h"
#include "scan/surfels.h"
#include "shading/gathered_light.h"
#include "shading/hit_lists.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// How far the shading of a surfel can be believed: a factor of confidence for each doubt, 0..1,
/// where 1 is none.
struct SurfelTrust
{
    float seen = 1.0f;   // falls where most of its rays leave the scan
    float front = 1.0f;  // falls where most of its rays meet backs of surfaces
    float edges = 1.0f;  // falls where shadow edges are not those of the texture, or the light had
                         // to be corrected by much, to 0.1
    float proven = 1.0f; // falls, everywhere, where albedo is no better than the scan
};

/// What the fronts of surfels look at, one entry a surfel.
std::vector<SurfelTrust> trustByView(const HitLists& hits, size_t surfels);

/// Lowers `edges` where `inPenumbra` is not 0 and the texture does not follow the shading: a
/// surfel's steps to its neighbours on the same plane, in log luminance, are to be those of
/// `irradiance`. A pattern that hides the shadow's edge is doubted like an edge in the wrong place:
/// nothing tells them apart.
void doubtEdges(const Surfels& surfels, const SurfelRadiance& radiance, const SurfelLighting& light,
                std::span<SurfelTrust> trust);

/// Lowers `edges` where the light had to be corrected by much, by `lit` times, one a surfel: a
/// third or more of what was corrected by a fifth is still off by 15 %.
void doubtCorrections(std::span<const float> lit, std::span<SurfelTrust> trust);

} // namespace relamp
