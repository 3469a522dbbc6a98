#pragma once

#include "fit/fit_data.h"
#include "scan/surfels.h"

#include <span>
#include <vector>

namespace relamp
{

/// Draws pairs of places that lie on one plane, as walls, floors and table tops do, near and far,
/// and whose colours do not rule out one material under differently coloured light.
///
/// `surfels` are the places of `data`, as indices into `all`. Deterministic. At most `perPlace`
/// pairs begin at each place.
std::vector<MaterialPair> drawPairs(const FitData& data, std::span<const uint32_t> surfels,
                                    const Surfels& all, size_t perPlace);

} // namespace relamp
