#pragma once

#include "scan/surfels.h"
#include "shading/lamp_sight.h"

#include <cstdint>
#include <vector>

namespace relamp
{

/// What of a light a surfel sees, as far as few rays tell.
enum class Seen : uint8_t { none, all, some };

/// Whether rays saw all of a light that is above a surface's horizon.
bool seesAll(const AreaSample& sample);

/// `coarse[surfel]` is what a few rays of each surfel's front saw. It is all or none only where
/// the ring of neighbours says the same, for else an edge may lie between them: that is some.
std::vector<Seen> seenBySurfels(const Surfels& surfels, const LampSight& coarse);

} // namespace relamp
