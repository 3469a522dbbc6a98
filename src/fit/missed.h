#pragma once

#include "fit/fit_data.h"
#include "fit/powers.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// How much each of several sets of lamps would be missed: by how much the fit's loss rises when
/// they are gone and all others are free to take their part.
///
/// `gone[i][lamp]` is not 0 where a lamp belongs to set i. `options` tell where the fit starts and
/// which lamps are alike.
std::vector<float> missed(const FitData& data, std::span<const MaterialPair> pairs,
                          const PowersOptions& options, std::span<const std::vector<uint8_t>> gone);

} // namespace relamp
