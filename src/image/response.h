#pragma once

#include "relamp/response.h"

#include <array>

namespace relamp
{

/// Covariances of the slopes of a Response, row by row.
using SlopeCovariance = std::array<float, Response::kKnots * Response::kKnots>;

/// How much the logarithm of radiance at a texture's value changes with each slope of a Response,
/// if white stays white.
std::array<float, Response::kKnots> bendAt(float texture);

/// How much the slope there does.
std::array<float, Response::kKnots> slopeAt(float texture);

} // namespace relamp
