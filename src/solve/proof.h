#pragma once

#include "fit/cross_validation.h"
#include "solve/solution.h"

#include <span>

#include <glm/vec3.hpp>

namespace relamp
{

/// Proves a solution at places that no fit looked at: sets its figures there and how far its
/// shading is believed, and where that is not all of it or albedo is no better than the scan, warns
/// and lowers the trust in all surfels, which is there already.
///
/// `irradiance`, one a surfel: that of the witnesses must not follow from what they show.
void prove(const Witnesses& witnesses, std::span<const glm::vec3> irradiance, Solution& solution);

} // namespace relamp
