#pragma once

#include "lights/shining.h"
#include "relamp/delight.h"
#include "scan/texels.h"
#include "shading/texel_shading.h"

#include <span>

namespace relamp
{

/// Shades, divides and rates all texels of a page; those that shine go to `emission`.
/// Where `fill` has an albedo for every surfel, it replaces what cannot be trusted.
PageLayers makeLayers(const Texels& texels, size_t page, const TexelShading& shade,
                      const Shining& shining, std::span<const glm::vec3> fill,
                      const AlbedoOptions& options, Progress& progress);

} // namespace relamp
