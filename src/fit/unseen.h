#pragma once

#include "fit/fitted_light.h"

#include <cstdint>
#include <vector>

namespace relamp
{

/// By how much the log albedo of places is another where the fit does not look at them: one a
/// place of `texture`.
///
/// Five fits from the one that is given leave out the pairs of a fold each (scan/held_out.h), and a
/// sixth leaves out none, to compare with. The same pieces emit in the same gathered light; what
/// they emit, outside and the camera's gain, or else its response where it is not known, are found
/// anew. Of one room: its camera has one gain at most.
std::vector<float> changeUnseen(const FittedLight& light, uint32_t seed);

} // namespace relamp
