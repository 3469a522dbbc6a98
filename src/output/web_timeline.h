#pragma once

#include "relamp/relight.h"
#include "relamp/timeline.h"

#include <nlohmann/json.hpp>

namespace relamp
{

/// What room.js says of light that changes: how many times its lightmap each light of a page gives
/// at moments of the timeline, in the order of partsOf(lighting). Throws Error(unsupported) where
/// the timeline does more than dim and colour these lights.
nlohmann::ordered_json webTimeline(const Timeline& timeline, const Relighting& lighting);

} // namespace relamp
