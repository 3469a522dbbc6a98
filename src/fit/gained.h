#pragma once

#include "fit/fit_data.h"
#include "fit/powers.h"

#include <span>
#include <vector>

namespace relamp
{

/// What one lamp more would do for a fit, all others as they are.
struct Gain
{
    float loss = 0.0f;     // by which the fit's loss falls, >= 0
    float radiance = 0.0f; // luminance at which it does so
};

/// The gain of each of several lamps that a fit does without. `direct[lamp]`: its irradiance at
/// radiance 1, one a measured place of `data`. In luminance, under the Cauchy loss of
/// PowersOptions::lastScale.
std::vector<Gain> gained(const FitData& data, std::span<const MaterialPair> pairs,
                         const Powers& powers, std::span<const std::span<const float>> direct);

} // namespace relamp
