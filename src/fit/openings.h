#pragma once

#include "lights/candidates.h"
#include "scan/texels.h"
#include "shading/hit_lists.h"

#include <vector>

namespace relamp
{

/// Where light can come in that the scan has no surface for: squares that stand beyond its holes
/// and face the room, those first that most rays leave through. A lamp that was not scanned shines
/// from one or some of them. What few rays leave through is left out, so a scan that is whole has
/// none.
///
/// Patches of no surfel.
std::vector<Candidate> openingsOf(const Texels& texels, const HitLists& hits);

} // namespace relamp
