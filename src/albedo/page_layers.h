#pragma once

#include "lights/emitters.h"
#include "relamp/delight.h"
#include "scan/texels.h"
#include "shading/thesis.h"

#include <span>

namespace relamp
{

/// Shades, divides and rates all texels of a page. `shines` tells for every surfel whether it
/// belongs to a fixture: its emitting texels go to `emission`.
PageLayers makeLayers(const Texels& texels, size_t page, const ThesisShading& shading,
                      std::span<const uint8_t> shines, const DelightOptions& options,
                      Progress& progress);

} // namespace relamp
