#include "base/half.h"
#include "base/parallel.h"
#include "image/padding.h"
#include "inside/flattened.h"
#include "scan/overlap.h"
#include "thesis/flatten.h"

#include <utility>

namespace relamp
{

std::vector<Image> flattened(const Scan& scan, const ThesisOptions& parameters, Progress& progress)
{
    const Texels texels = rasterizeAtlas(scan, progress);
    checkOverlap(texels);
    const Flattened colours = flatten(
        texels, {.reach = parameters.flattenReach, .range = parameters.flattenRange}, progress);
    std::vector<Image> pages;
    for (size_t p = 0; p < scan.pages.size(); ++p) {
        Image page;
        page.width = scan.pages[p].image.width;
        page.height = scan.pages[p].image.height;
        page.transfer = Transfer::linear;
        std::vector<uint16_t> half(3 * page.pixels());
        forEachChunk(page.pixels(), 1 << 14, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                const glm::vec3 rgb = colours.at(p, i);
                for (size_t c = 0; c < 3; ++c)
                    half[3 * i + c] = halfFromFloat(rgb[static_cast<int>(c)]);
            }
        });
        page.rgb = std::move(half);
        pages.push_back(std::move(page));
    }
    return pages;
}

} // namespace relamp
