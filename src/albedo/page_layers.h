#pragma once

#include "albedo/doubts.h"
#include "lights/shining.h"
#include "relamp/delight.h"
#include "scan/texels.h"
#include "shading/texel_shading.h"

#include <span>

namespace relamp
{

/// What a solver says of the texels.
struct SolvedTexels
{
    const TexelShading& shade;
    const Shining& shining;
    std::span<const SurfelTrust> trust; // in the shading of surfels; empty: full
    std::span<const glm::vec3> fill;    // albedo of surfels, for what is burnt out; or none
};

/// Shades, divides and rates all texels of a page; those that shine go to `emission`.
PageLayers makeLayers(const Texels& texels, size_t page, const SolvedTexels& solved,
                      const AlbedoOptions& options, Progress& progress);

} // namespace relamp
