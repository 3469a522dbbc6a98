#pragma once

#include "lights/surfel_radiance.h"
#include "scan/surfels.h"
#include "scan/texels.h"
#include "shading/hit_lists.h"
#include "shading/texel_shading.h"

#include <span>
#include <vector>

namespace relamp
{

/// How much of the light that was found on each surfel is there, 0..1.05: the rest is shade that
/// the mesh does not tell of.
///
/// What throws it is missing from the scan, or off by a few centimetres. It shows as albedo that
/// fades within one paint, towards places that are dark anyway: a smooth change is light, an edge
/// is paint (Land and McCann 1971), and bright places are right. `irradiance`: found, one a surfel.
/// A surfel that is burnt out keeps its light. A thin pattern is paint unless `hits`, of all
/// fronts, say that something is near.
std::vector<float> findShade(const Surfels& surfels, const SurfelRadiance& radiance,
                             const HitLists& hits, std::span<const glm::vec3> irradiance);

/// The shading, darkened by that, interpolated between surfels.
TexelShading withShade(const Texels& texels, TexelShading shade, std::span<const float> lit);

} // namespace relamp
