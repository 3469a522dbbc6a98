#include "relamp/estimate.h"

#include "scan/large_scan.h"

#include <algorithm>

namespace relamp
{
namespace
{

// m^2. Beyond 750 thousand squares of 3 cm surfels are larger and not more: more surface costs no
// more. What stands on it does, up to about twice as much.
constexpr double kMostSurface = 700.0;
constexpr double kMostSurfaceOfCharts = 1400.0;

/// What a command's cost is made of; the rates are those of bench/costs.py (docs/dev/notebook.md,
/// 2026-11-27).
struct Rates
{
    double fixed;              // the program, its libraries, the rays of a room
    double perPixel;           // of all pages: the texture
    double perPixelOfPage;     // of the largest page: layers are made and written page by page
    double perTexel;           // where each lies, and its shading
    double perTriangle;        // the ray tree
    double perSquareMetre;     // surfels
    double perLampSquareMetre; // what each lamp brings to each surfel
    double perChart;           // pieces of surface: how cluttered a room is
};

struct Sizes
{
    double pixels = 0.0;
    double largestPage = 0.0; // pixels
    double texels = 0.0;
    double triangles = 0.0;
    double squareMetres = 0.0;
    double lamps = 0.0;
    double charts = 0.0;
};

Sizes sizesOf(const Inspection& found, size_t fixtures)
{
    Sizes sizes{.texels = static_cast<double>(found.texels),
                .triangles = static_cast<double>(found.triangles),
                .squareMetres = found.squareMetres,
                .lamps = static_cast<double>(fixtures)};
    for (const PageInspection& page : found.pages) {
        const double pixels = static_cast<double>(page.width) * page.height;
        sizes.pixels += pixels;
        sizes.charts += static_cast<double>(page.charts);
        sizes.largestPage = std::max(sizes.largestPage, pixels);
    }
    sizes.charts *= std::min(1.0, kMostSurfaceOfCharts / std::max(sizes.squareMetres, 1.0));
    sizes.squareMetres = std::min(sizes.squareMetres, kMostSurface);
    return sizes;
}

double sum(const Rates& rates, const Sizes& of)
{
    return rates.fixed + rates.perPixel * of.pixels + rates.perPixelOfPage * of.largestPage +
           rates.perTexel * of.texels + rates.perTriangle * of.triangles +
           rates.perSquareMetre * of.squareMetres +
           rates.perLampSquareMetre * of.lamps * of.squareMetres + rates.perChart * of.charts;
}

// Bytes.
constexpr Rates kDelightMemory{9.2e7, 35, 12, 0.0, 4.6e2, 5.1e5, 0.0, 2.4e4};
// Of a large scan, whose pages lie in files (large_scan.h).
constexpr Rates kLargeDelightMemory{9.2e7, 0.37, 47, 0.0, 6.6e2, 5.1e5, 0.0, 2.4e4};
constexpr Rates kVerifyMemory{2e8, 15, 0.0, 22, 2.8e2, 7.6e4, 1.5e4, 1.8e4};
constexpr Rates kRelightMemory{1.9e8, 16, 7.8, 24, 2.9e2, 8.2e4, 3.5e4, 2.3e4};
// Seconds of a core.
constexpr Rates kDelightSeconds{1.1, 0.0, 1.8e-07, 8.3e-07, 2.4e-05, 0.0, 0.0015, 0.0023};
constexpr Rates kVerifySeconds{1.9, 0.0, 2.5e-07, 2.9e-07, 3.2e-05, 0.0, 0.00065, 0.0012};
constexpr Rates kRelightSeconds{1.0, 0.0, 1.08e-06, 9e-07, 2.2e-05, 0.0, 0.0011, 0.0014};

} // namespace

Estimate estimate(const Inspection& found, size_t fixtures)
{
    const Sizes sizes = sizesOf(found, fixtures);
    const bool isLarge = sizes.pixels > static_cast<double>(pixelsInMemory());
    const Rates& delightMemory = isLarge ? kLargeDelightMemory : kDelightMemory;
    return {.delight = {sum(delightMemory, sizes), sum(kDelightSeconds, sizes)},
            .verify = {sum(kVerifyMemory, sizes), sum(kVerifySeconds, sizes)},
            .relight = {sum(kRelightMemory, sizes), sum(kRelightSeconds, sizes)}};
}

} // namespace relamp
