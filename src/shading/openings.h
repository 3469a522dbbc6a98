#pragma once

#include "scan/texels.h"
#include "shading/hit_lists.h"

#include <cstddef>
#include <vector>

namespace relamp
{

/// Tells what lies outside a scan apart, by where rays leave the box around it. Every large hole in
/// one of its sides is an opening; those in upright sides, windows mostly, have two parts, above
/// and below the horizon, for what is seen there is far. Part 0 is the rest, all small holes
/// together. Fills in the parts of targets that are nothing,
/// HitLists::shareOfPart, HitLists::holes and HitLists::squares.
void tellPartsApart(const Texels& texels, HitLists& hits);

/// HitLists::shareOfPart of so many, by what left for each.
std::vector<float> sharesOfParts(const Texels& texels, const HitLists& hits, size_t parts);

} // namespace relamp
