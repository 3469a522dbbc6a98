#include "albedo/page_layers.h"

#include "albedo/confidence.h"
#include "albedo/divide.h"
#include "base/half.h"
#include "image/gutter.h"
#include "image/transfer.h"
#include "lights/emitters.h"

#include <algorithm>

namespace relamp
{
namespace
{

constexpr float kAlbedoOfFixtures =
    0.6f; // a lamp's own glass cannot be seen for its light; confidence says so

void storeRgb(std::vector<uint16_t>& layer, uint32_t pixel, const RgbBlock& block, size_t i)
{
    uint16_t* rgb = &layer[3 * size_t{pixel}];
    rgb[0] = halfFromFloat(block.r[i]);
    rgb[1] = halfFromFloat(block.g[i]);
    rgb[2] = halfFromFloat(block.b[i]);
}

class LayerMaker
{
public:
    LayerMaker(const Texels& texels, size_t page, const TexelShading& shade, const Shining& shining,
               const AlbedoOptions& options);

    PageLayers run(Progress::Stage& stage);

private:
    void makeBlock(size_t begin, size_t count);
    void storeTexel(const TexelBlock& block, const ShadingBlock& shade, const AlbedoBlock& albedo,
                    size_t i, uint32_t pixel);
    void fill();

    size_t page_;
    const PageTexels& texels_;
    TexelLoader loader_;
    const TexelShading& shade_;
    const Shining& shining_;
    const AlbedoOptions& options_;
    PageLayers layers_;
    std::vector<uint8_t> covered_;
    bool ofVertices_;
    bool clips_;
};

LayerMaker::LayerMaker(const Texels& texels, size_t page, const TexelShading& shade,
                       const Shining& shining, const AlbedoOptions& options)
    : page_(page), texels_(texels.pages[page]), loader_(texels, page), shade_(shade),
      shining_(shining), options_(options), ofVertices_(texels.scan->pages[page].ofVertices),
      clips_(texels.scan->pages[page].image.clipsAtWhite)
{
    const Image& image = texels.scan->pages[page].image;
    layers_.width = image.width;
    layers_.height = image.height;
    for (auto* layer : {&layers_.albedo, &layers_.direct, &layers_.indirect})
        layer->resize(3 * image.pixels());
    layers_.emission.resize(3 * image.pixels());
    layers_.confidence.resize(image.pixels());
    covered_.resize(image.pixels());
}

void LayerMaker::storeTexel(const TexelBlock& block, const ShadingBlock& shade,
                            const AlbedoBlock& albedo, size_t i, uint32_t pixel)
{
    covered_[pixel] = 1;
    storeRgb(layers_.direct, pixel, shade.direct, i);
    storeRgb(layers_.indirect, pixel, shade.indirect, i);
    const glm::vec3 radiance(block.r[i], block.g[i], block.b[i]);
    uint16_t* rho = &layers_.albedo[3 * size_t{pixel}];
    if (shining_.surfels[block.surfel[i]] &&
        isEmitting(radiance, clips_, {.threshold = shining_.threshold})) {
        for (int c = 0; c < 3; ++c) {
            rho[c] = halfFromFloat(kAlbedoOfFixtures);
            layers_.emission[3 * size_t{pixel} + static_cast<size_t>(c)] =
                srgbByteFromLinear(radiance[c]);
        }
        return; // confidence stays 0
    }
    rho[0] = albedo.r[i];
    rho[1] = albedo.g[i];
    rho[2] = albedo.b[i];
    const glm::vec3 total(shade.direct.r[i] + shade.indirect.r[i],
                          shade.direct.g[i] + shade.indirect.g[i],
                          shade.direct.b[i] + shade.indirect.b[i]);
    layers_.confidence[pixel] =
        confidenceByte(confidence(radiance, clips_, total, options_.darkest));
}

void LayerMaker::makeBlock(size_t begin, size_t count)
{
    TexelBlock block;
    ShadingBlock shading;
    AlbedoBlock albedo;
    loader_.load(begin, count, block);
    loader_.loadSurfel(begin, count, block);
    shade_(page_, begin, block, shading);
    divide(block, shading, options_.darkest, albedo);
    for (size_t i = 0; i < count; ++i)
        storeTexel(block, shading, albedo, i, texels_.pixel[begin + i]);
}

void LayerMaker::fill()
{
    if (ofVertices_) return; // its pixels have no neighbours
    for (auto* layer : {&layers_.albedo, &layers_.direct, &layers_.indirect})
        fillGutters(std::span(*layer), covered_, layers_.width, layers_.height);
    if (!layers_.emission.empty())
        fillGutters(std::span(layers_.emission), covered_, layers_.width, layers_.height);
}

PageLayers LayerMaker::run(Progress::Stage& stage)
{
    forEachBlock(texels_, [&](size_t begin, size_t count) {
        makeBlock(begin, count);
        stage.advance(count);
    });
    const auto shines = [](uint8_t v) { return v != 0; };
    if (std::none_of(layers_.emission.begin(), layers_.emission.end(), shines))
        layers_.emission = {};
    fill();
    return std::move(layers_);
}

} // namespace

PageLayers makeLayers(const Texels& texels, size_t page, const TexelShading& shade,
                      const Shining& shining, const AlbedoOptions& options, Progress& progress)
{
    Progress::Stage stage(progress, "divide", texels.pages[page].count());
    return LayerMaker(texels, page, shade, shining, options).run(stage);
}

} // namespace relamp
