#pragma once

#include "scan/surfels.h"
#include "shading/hit_lists.h"
#include "shading/lit_sides.h"

#include <vector>

namespace relamp
{

/// Luminance that each surfel can send at most. Where no camera can have been, that is all of the
/// light that it or a neighbour of it gets, on the whitest paint: texture that shows more was
/// filled in from elsewhere. Others have no limit: they may shine.
std::vector<float> energyLimit(const Surfels& surfels, const HitLists& hits, const LitSides& sides);

} // namespace relamp
