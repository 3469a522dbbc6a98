#include "relight/relit_page.h"

#include "base/half.h"
#include "image/padding.h"

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

Image relitPage(const Relighter::State& state, size_t p, Progress& progress)
{
    const PageTexels& page = state.texels.pages[p];
    const Image& original = state.room.scan->pages[p].image;
    Image relit;
    relit.width = original.width;
    relit.height = original.height;
    relit.transfer = Transfer::linear;
    relit.clipsAtWhite = false;
    relit.alpha = original.alpha;
    std::vector<uint16_t> rgb(3 * original.pixels());
    std::vector<uint8_t> covered(original.pixels());
    Progress::Stage stage(progress, "bake", page.count());
    const TexelLoader loader(state.texels, p);
    forEachBlock(page, [&](size_t begin, size_t count) {
        TexelBlock block;
        ShadingBlock shading;
        loader.loadGeometry(begin, count, block);
        loader.loadSurfel(begin, count, block);
        state.shade(p, begin, block, shading);
        for (size_t i = 0; i < count; ++i) {
            const uint32_t pixel = page.pixel[begin + i];
            const uint32_t surfel = block.surfel[i];
            const bool shines =
                state.active.shines[surfel] != 0 && state.radiance.isClipped[p][pixel] != 0;
            const glm::vec3 total(shading.direct.r[i] + shading.indirect.r[i],
                                  shading.direct.g[i] + shading.indirect.g[i],
                                  shading.direct.b[i] + shading.indirect.b[i]);
            const glm::vec3 radiance = shines ? state.active.emission[surfel]
                                              : state.albedo.ofTexel(p, pixel, surfel) * total;
            for (int c = 0; c < 3; ++c)
                rgb[3 * size_t{pixel} + static_cast<size_t>(c)] =
                    halfFromFloat(std::max(radiance[c], 0.0f));
            covered[pixel] = 1;
        }
        stage.advance(count);
    });
    if (!state.room.scan->pages[p].ofVertices)
        fillPadding(std::span(rgb), covered, relit.width, relit.height);
    relit.rgb = std::move(rgb);
    return relit;
}

} // namespace relamp
