#pragma once

#include "scan/facets.h"
#include "scan/overlap.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace relamp
{

/// Which facet each pixel of a page shows.
struct PageCoverage
{
    std::vector<uint32_t> pixel; // row * width + column, ascending
    std::vector<uint32_t> facet; // of the same texel

    /// A texel whose inside several facets want, or that what lies beyond the page's edge repeats.
    struct Shared
    {
        uint32_t pixel;
        OverlapKind kind;
        bool isWanted; // by several facets on the page; else by what lies beyond, see `outside`
    };
    std::vector<Shared> shared;        // ascending
    double outside = 0.0;              // area in texels of what triangles have beyond the page
    std::map<uint32_t, double> inMesh; // texels of both, by mesh
    std::vector<std::pair<uint32_t, uint32_t>> inFront; // pixel and facet: the one that is seen
                                                        // where surfaces that are alike share it

    /// Whether so few are shared that it is rounding; then all is as if none were.
    [[nodiscard]] bool isOfSeamsAlone() const;
    /// Gives the pixels of `inFront` to these facets.
    void showFronts();
};

/// Rasterises all facets of a page.
///
/// A texel is covered where its centre lies in a triangle; where several do, the first facet has
/// it, whatever the number of threads; but of two surfaces that are alike, the one that is seen.
PageCoverage rasterizePage(const Scan& scan, const Facets& facets, uint32_t page);

} // namespace relamp
