#pragma once

#include "lights/surfel_radiance.h"
#include "relamp/progress.h"
#include "scan/rays.h"
#include "scan/split_surfels.h"
#include "shading/texel_shading.h"

#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Makes texels that something stands on or lies on surfels of their own: three of four rays from
/// them, or more, meet a surface from behind, as inside a solid. Where a rug lies on a floor, that
/// floor would else send and get the mean of light and darkness. A modelled room has many, a
/// scanned one hardly any. None where most are, for then the scan is inside out. Finds the
/// neighbours of all surfels.
void separateEnclosed(Texels& texels, const RayScene& scene, Progress& progress);

/// How much of each texel lies open, 0..255: of enclosed ones, of which the middle does not, by
/// rays from all over them; of others all.
TexelMarks openShares(const Texels& texels, const RayScene& scene);

/// What is around an enclosed surfel.
struct Rim
{
    glm::vec3 shading{0.0f};
    float albedo = 0.0f; // luminance; 0: nothing is open around it, or it is not enclosed
};

/// One a surfel. `irradiance`: found, one a surfel.
std::vector<Rim> rimsOf(const Surfels& surfels, const SurfelRadiance& radiance,
                        std::span<const glm::vec3> irradiance);

/// Adds some of the light around on enclosed texels at the rim of what lies there: such a texel is
/// part open, and shows more than the light under a thing can make of the paint around. So the
/// texture tells how much; the block comes with radiance and surfels loaded.
void letRimsIn(std::span<const Rim> rims, const TexelBlock& block, ShadingBlock& shading);

/// The shading, with as much of the light around as lies open. `open`: as openShares gives them.
TexelShading withRims(const Texels& texels, TexelShading shade, std::vector<Rim> rims,
                      std::shared_ptr<const TexelMarks> open);

} // namespace relamp
