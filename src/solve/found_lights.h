#pragma once

#include "relamp/delight.h"
#include "relamp/lights.h"
#include "solve/found_room.h"

#include <cstdint>
#include <vector>

namespace relamp
{

/// Lamps and the sun as people see and edit them: as bright as the scaled shading says, where
/// LampPowers are those before the scale.
Lights lightsOf(const FoundRoom& room);
/// The same as LampPowers has them. Throws Error(malformed) where the scale is not above 0.
Lights beforeScale(Lights lights);

/// The large holes of the scan, with the light that comes in.
std::vector<Opening> openingsOf(const FoundRoom& room);

/// Whose the burnt-out texels of each surfel are, as fixtureMapOf() takes it; lamps that are off
/// have theirs, a patch of sun has none.
std::vector<int32_t> fixturesOfSurfels(const FoundRoom& room);

} // namespace relamp
