#pragma once

#include "fit/powers.h"

#include <span>

namespace relamp
{

/// Powers without what dark places get wrong.
///
/// Through the gaps of a reconstruction light gets into corners that were dark in the room. There
/// the model is brighter than the scan, and lamps come out stronger than they are, for that makes
/// what is lit as much brighter. So pairs with a place that gets less than half of the median light
/// are left out, if the lamps are weaker then; in a mesh without gaps they are not, and dark places
/// tell as much as others. `areas` are the lamps', m^2.
Powers fitLitPowers(const FitData& data, std::span<const MaterialPair> pairs,
                    std::span<const float> areas, PowersOptions options = {});

} // namespace relamp
