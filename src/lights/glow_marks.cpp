#include "lights/glow_marks.h"

#include "base/radiometry.shared.h"

#include <algorithm>
#include <limits>

namespace relamp
{
namespace
{

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr float kAsHalves = 0.999f; // a half float has eleven bits

/// Calls `visit(surfel, pixel, luminance)` for all texels of a page of surfels that `matters`.
template<class Matters, class Visit>
void forEachTexel(const Texels& texels, size_t p, const Linearization* linearization,
                  const Matters& matters, const Visit& visit)
{
    const PageTexels& page = texels.pages[p];
    const TexelLoader loader(texels, p, linearization);
    forEachRun(page, [&](size_t run, TexelBlock& block) {
        const uint32_t surfel = page.runs[run].surfel;
        if (!matters(surfel)) return;
        forEachBlockOfRun(page, run, [&](size_t begin, size_t count) {
            loader.load(begin, count, block);
            for (size_t i = 0; i < count; ++i)
                visit(surfel, page.pixel[begin + i],
                      luminance(glm::vec3(block.r[i], block.g[i], block.b[i])));
        });
    });
}

} // namespace

GlowMarks glowingFrom(const Texels& texels, std::span<const float> from,
                      const Linearization* linearization)
{
    GlowMarks marks;
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        std::vector<uint8_t> page(texels.scan->pages[p].image.pixels(), 0);
        forEachTexel(
            texels, p, linearization, [&](uint32_t surfel) { return from[surfel] < kNone; },
            [&](uint32_t surfel, uint32_t pixel, float shown) {
                page[pixel] = shown >= from[surfel] ? 1 : 0;
            });
        marks.isGlowing.push_back(marksFrom(page));
    }
    return marks;
}

GlowMarks glowingBy(std::span<const FixtureMap> maps, std::span<const std::vector<bool>> isBurntOut)
{
    GlowMarks marks;
    bool isAny = false;
    for (size_t p = 0; p < std::min(maps.size(), isBurntOut.size()); ++p) {
        std::vector<bool>& page = marks.isGlowing.emplace_back(isBurntOut[p].size());
        if (maps[p].id.size() != page.size()) continue;
        for (size_t pixel = 0; pixel < page.size(); ++pixel) {
            page[pixel] = maps[p].id[pixel] >= 0 && !isBurntOut[p][pixel];
            isAny = isAny || page[pixel];
        }
    }
    return isAny ? marks : GlowMarks{};
}

PixelMarks withGlowing(PixelMarks isBurntOut, const GlowMarks& marks)
{
    for (size_t p = 0; p < marks.isGlowing.size(); ++p)
        for (size_t pixel = 0; pixel < isBurntOut[p].size(); ++pixel)
            isBurntOut[p][pixel] = isBurntOut[p][pixel] || marks.isGlowing[p][pixel];
    return isBurntOut;
}

std::vector<float> leastOfGlowing(const Texels& texels, const GlowMarks& marks,
                                  const Linearization* linearization)
{
    if (marks.areNone()) return {};
    std::vector<float> least(texels.surfels.count(), kNone);
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        forEachTexel( // a surfel has one run a page
            texels, p, linearization, [](uint32_t) { return true; },
            [&](uint32_t surfel, uint32_t pixel, float shown) {
                if (marks.isGlowing[p][pixel])
                    least[surfel] = std::min(least[surfel], kAsHalves * shown);
            });
    }
    return least;
}

} // namespace relamp
