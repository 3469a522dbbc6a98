#pragma once

#include "rooms/plans.h"
#include "rooms/room.h"

namespace relamp::rooms
{

/// Builds walls, lamps, windows and furniture of a plan; always the same of the same plan. The
/// room's floor begins at the origin; Y is up.
Room furnish(const Plan& plan);

} // namespace relamp::rooms
