#pragma once

#include "fit/light_model.h"
#include "lights/surfel_radiance.h"
#include "relamp/gather.h"
#include "scan/surfels.h"

#include <cstdint>
#include <string>
#include <vector>

namespace relamp
{

/// What a person said of the paint of surfels.
struct ToldPaint
{
    std::vector<MaterialPair> same; // of one paint, each two
    std::vector<uint32_t> white;    // as white as paper can be
};

/// The surfels that a person speaks of: those nearest to the places of `options`. `warnings`
/// receives a sentence where no surface is near, or what is there is burnt out and shows no paint;
/// that is passed over.
ToldPaint toldPaintOf(const GatherOptions& options, const Surfels& surfels,
                      const SurfelRadiance& radiance, std::vector<std::string>& warnings);

} // namespace relamp
