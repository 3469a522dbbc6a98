#pragma once

#include "lights/candidates.h"
#include "scan/texels.h"
#include "shading/hit_lists.h"

#include <vector>

namespace relamp
{

/// Tells what lies outside a scan apart, by where rays leave the box around it. Every large hole in
/// one of its sides is an opening; those in upright sides, windows mostly, have two parts, above
/// and below the horizon, for what is seen there is far. Part 0 is the rest, all small holes
/// together. Fills in the parts of targets that are nothing,
/// HitLists::shareOfPart and HitLists::holes.
void tellPartsApart(const Texels& texels, HitLists& hits);

/// Where lamps can be that the scan has no surface for: squares just beyond the holes in its top
/// and bottom, which face the room, those first that most rays leave through. What few rays leave
/// through is left out, so a scan that is whole has none.
///
/// Patches of no surfel.
std::vector<Candidate> openingsOf(const Texels& texels, const HitLists& hits);

} // namespace relamp
