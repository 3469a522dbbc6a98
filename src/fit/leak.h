#pragma once

#include "fit/powers.h"

namespace relamp
{

/// How much light comes to places through gaps of the mesh, as PowersOptions::leak: what makes the
/// pairs likeliest. 0 where the mesh is whole.
///
/// `options` as for fitPowers(); their own leak is passed over.
double findLeak(const FitData& data, std::span<const MaterialPair> pairs,
                const PowersOptions& options);

} // namespace relamp
