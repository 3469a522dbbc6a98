#include "relight/relit_page.h"

#include "base/half.h"
#include "base/parallel.h"
#include "image/padding.h"
#include "scan/coarsened.h"

#include <algorithm>

namespace relamp
{

std::vector<glm::vec3> reflecting(const Relighter::State& state)
{
    std::vector<glm::vec3> albedo = state.albedo.ofSurfels();
    for (size_t s = 0; s < albedo.size(); ++s)
        if (state.active.shines[s] != 0)
            albedo[s] *=
                state.radiance.plainArea[s] /
                std::max(state.radiance.plainArea[s] + state.radiance.clippedArea[s], 1e-20f);
    return albedo;
}

namespace
{

Image linearImage(int width, int height)
{
    Image image;
    image.width = width;
    image.height = height;
    image.transfer = Transfer::linear;
    image.clipsAtWhite = false;
    return image;
}

/// Calls `take(pixel, surfel, shading)` for the texels of a page, on many threads.
template<class Take>
void forEachLitTexel(const Relighter::State& state, size_t p, Progress& progress, const Take& take)
{
    const PageTexels& page = state.texels.pages[p];
    Progress::Stage stage(progress, "bake", page.count());
    const TexelLoader loader(state.texels, p);
    forEachBlock(page, [&](size_t begin, size_t count) {
        TexelBlock block;
        ShadingBlock shading;
        loader.loadGeometry(begin, count, block);
        loader.loadSurfel(begin, count, block);
        state.shade(p, begin, block, shading);
        for (size_t i = 0; i < count; ++i)
            take(page.pixel[begin + i], block.surfel[i],
                 glm::vec3(shading.direct.r[i] + shading.indirect.r[i],
                           shading.direct.g[i] + shading.indirect.g[i],
                           shading.direct.b[i] + shading.indirect.b[i]));
        stage.advance(count);
    });
}

/// Pixels of a page in blocks of `factor` along each side, fewer where the page ends.
struct Blocks
{
    Blocks(const Page& page, int longestSide)
        : factor(longestSide > 0 ? coarseFactor(page, longestSide) : 1),
          width((page.image.width + factor - 1) / factor),
          height((page.image.height + factor - 1) / factor), pageWidth(page.image.width)
    {}

    [[nodiscard]] size_t of(uint32_t pixel) const
    {
        const auto x = static_cast<int>(pixel) % pageWidth;
        const auto y = static_cast<int>(pixel) / pageWidth;
        return static_cast<size_t>(y / factor) * static_cast<size_t>(width) +
               static_cast<size_t>(x / factor);
    }
    [[nodiscard]] size_t count() const
    {
        return static_cast<size_t>(width) * static_cast<size_t>(height);
    }

    int factor;
    int width;
    int height;
    int pageWidth;
};

void storeHalf(std::span<uint16_t> rgb, size_t pixel, glm::vec3 value)
{
    for (int c = 0; c < 3; ++c)
        rgb[3 * pixel + static_cast<size_t>(c)] = halfFromFloat(std::max(value[c], 0.0f));
}

} // namespace

Image relitPage(const Relighter::State& state, size_t p, Progress& progress)
{
    const Image& original = state.room.scan->pages[p].image;
    Image relit = linearImage(original.width, original.height);
    relit.alpha = original.alpha;
    std::vector<uint16_t> rgb(3 * original.pixels());
    std::vector<uint8_t> covered(original.pixels());
    forEachLitTexel(state, p, progress, [&](uint32_t pixel, uint32_t surfel, glm::vec3 shading) {
        const bool shines = state.active.shines[surfel] != 0 && state.radiance.isClipped[p][pixel];
        storeHalf(rgb, pixel,
                  shines ? state.active.emission[surfel]
                         : state.albedo.ofTexel(p, pixel, surfel) * shading);
        covered[pixel] = 1;
    });
    if (!state.room.scan->pages[p].ofVertices)
        fillPadding(std::span(rgb), covered, relit.width, relit.height);
    relit.rgb = std::move(rgb);
    return relit;
}

Image albedoPage(const Relighter::State& state, size_t p)
{
    const PageTexels& page = state.texels.pages[p];
    const Image& original = state.room.scan->pages[p].image;
    Image albedo = linearImage(original.width, original.height);
    std::vector<uint16_t> rgb(3 * original.pixels());
    std::vector<uint8_t> covered(original.pixels());
    forEachChunk(page.runs.size() - 1, 256, [&](size_t begin, size_t end) {
        for (size_t run = begin; run < end; ++run)
            for (size_t i = page.runs[run].begin; i < page.runs[run + 1].begin; ++i) {
                const uint32_t pixel = page.pixel[i];
                storeHalf(rgb, pixel, state.albedo.ofTexel(p, pixel, page.runs[run].surfel));
                covered[pixel] = 1;
            }
    });
    if (!state.room.scan->pages[p].ofVertices)
        fillPadding(std::span(rgb), covered, albedo.width, albedo.height);
    albedo.rgb = std::move(rgb);
    return albedo;
}

Image shadingPage(const Relighter::State& state, size_t p, int longestSide, Progress& progress)
{
    const Page& page = state.room.scan->pages[p];
    std::vector<glm::vec3> ofPixel(page.image.pixels(), glm::vec3(-1.0f)); // less than 0: nothing
    forEachLitTexel(state, p, progress, [&](uint32_t pixel, uint32_t, glm::vec3 shading) {
        ofPixel[pixel] = glm::max(shading, 0.0f);
    });
    const Blocks blocks(page, longestSide);
    std::vector<glm::vec3> sum(blocks.count(), glm::vec3(0.0f));
    std::vector<uint32_t> count(blocks.count(), 0);
    for (size_t pixel = 0; pixel < ofPixel.size(); ++pixel) {
        if (ofPixel[pixel].r < 0.0f) continue;
        const size_t block = blocks.of(static_cast<uint32_t>(pixel));
        sum[block] += ofPixel[pixel];
        ++count[block];
    }
    Image shading = linearImage(blocks.width, blocks.height);
    std::vector<uint16_t> rgb(3 * blocks.count());
    std::vector<uint8_t> covered(blocks.count());
    for (size_t block = 0; block < blocks.count(); ++block) {
        if (count[block] == 0) continue;
        storeHalf(rgb, block, sum[block] / static_cast<float>(count[block]));
        covered[block] = 1;
    }
    if (!page.ofVertices) fillPadding(std::span(rgb), covered, blocks.width, blocks.height);
    shading.rgb = std::move(rgb);
    return shading;
}

} // namespace relamp
