#pragma once

#include "lights/surfel_radiance.h"
#include "relamp/relight.h"
#include "scan/rays.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// Which fixtures a person would take for windows: upright, not small, and nothing of the scan lies
/// behind. `surfaces` are theirs, one a fixture.
std::vector<uint8_t> likelyWindowOpenings(const RayScene& scene,
                                          std::span<const std::vector<ClippedPatch>> surfaces);

/// Opens them to sun and sky, if there is any and nobody said which fixture is a window. One that
/// is on is left as it is: its light is known. `isOpening` is of `captured`.
Relighting withWindowOpenings(Relighting lighting, const Lights& captured,
                              std::span<const uint8_t> isOpening);

} // namespace relamp
