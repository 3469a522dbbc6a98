#pragma once

#include "scan/texels.h"
#include "shading/hit_lists.h"

#include <cstdint>
#include <vector>

namespace relamp
{

/// Which room of a house each surfel is in, by what its rays meet: most of what one sees is of the
/// room that one is in, through doors and windows too. The largest is 0; all beyond `most` and what
/// is too small for a room are of the room that they see most of.
std::vector<uint8_t> roomsOfSurfels(const Texels& texels, const HitLists& hits, size_t most);

/// Makes these the rooms of the lists, where there are several: the small holes of each room but
/// the first become a part of what lies outside by itself, behind all others, for what lies behind
/// them is as bright as the room beside it is.
void tellRoomsApart(const Texels& texels, std::vector<uint8_t> roomOfSurfel, HitLists& hits);

} // namespace relamp
