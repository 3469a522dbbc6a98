#pragma once

#include "scan/facets.h"

#include <cstdint>
#include <vector>

namespace relamp
{

/// Which facet each pixel of a page shows.
struct PageCoverage
{
    std::vector<uint32_t> pixel; // row * width + column, ascending
    std::vector<uint32_t> facet; // of the same texel
    uint64_t contested =
        0;                // how often a second facet wanted the inside of a texel: overlapping UVs
    double outside = 0.0; // area in texels of what triangles have beyond the page: tiled textures
};

/// Rasterises all facets of a page.
///
/// A texel is covered where its centre lies in a triangle; where several do, the first facet has
/// it, whatever the number of threads.
PageCoverage rasterizePage(const Scan& scan, const Facets& facets, uint32_t page);

} // namespace relamp
