#pragma once

#include "lights/shining.h"
#include "relamp/delight.h"
#include "scan/texels.h"
#include "shading/texel_shading.h"

namespace relamp
{

/// Shades, divides and rates all texels of a page; those that shine go to `emission`.
PageLayers makeLayers(const Texels& texels, size_t page, const TexelShading& shade,
                      const Shining& shining, const AlbedoOptions& options, Progress& progress);

} // namespace relamp
