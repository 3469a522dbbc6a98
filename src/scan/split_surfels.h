#pragma once

#include "scan/texels.h"

#include <cstdint>
#include <vector>

namespace relamp
{

/// [page][texel]: not 0 for some.
using TexelMarks = std::vector<std::vector<uint8_t>>;

/// Surfels by their cells, and their neighbours, from keys, places and normals.
void findNeighbors(Surfels& surfels);

/// Means and sums of surfels over their texels. Keys are there.
void sumSurfels(Texels& texels);

/// Makes marked texels surfels of their own, `part` of those that they were of. Texels are sorted
/// anew; neighbours are to be found again.
void splitSurfels(Texels& texels, const TexelMarks& marks, SurfelPart part);

/// Splits surfels in which one surface lies closely before another, as a pane before a wall or two
/// boards of a cupboard: the light of one is not that of the other.
void separateLayers(Texels& texels);

} // namespace relamp
