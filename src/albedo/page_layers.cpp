#include "albedo/page_layers.h"

#include "albedo/confidence.h"
#include "albedo/divide.h"
#include "albedo/fill.shared.h"
#include "albedo/layer_parts.h"
#include "albedo/page_layers.shared.h"
#include "albedo/paint_prior.shared.h"
#include "base/half.h"
#include "image/padding.h"
#include "image/texture_noise.h"
#include "lights/shining.shared.h"

#include <algorithm>
#include <span>

namespace relamp
{
namespace
{

void storeRgb(std::vector<uint16_t>& layer, uint32_t pixel, const RgbBlock& block, size_t i,
              glm::vec3 scale)
{
    uint16_t* rgb = &layer[3 * size_t{pixel}];
    rgb[0] = halfFromFloat(scale.r * block.r[i]);
    rgb[1] = halfFromFloat(scale.g * block.g[i]);
    rgb[2] = halfFromFloat(scale.b * block.b[i]);
}

class LayerMaker
{
public:
    LayerMaker(const Texels& texels, size_t page, const SolvedTexels& solved,
               const AlbedoOptions& options);

    PageLayers run(Progress::Stage& stage);

private:
    void makeBlock(size_t begin, size_t count);
    void storeTexel(const TexelBlock& block, const ShadingBlock& shade, const AlbedoBlock& albedo,
                    size_t i, uint32_t pixel);
    glm::vec3 fillChannels(glm::vec3 shown, glm::vec3 burntOut, glm::vec3 shading, uint32_t surfel,
                           float lack, uint16_t* rho) const;
    [[nodiscard]] float doubtOf(uint32_t surfel) const;
    void fillPadding();

    size_t page_;
    const PageTexels& texels_;
    TexelLoader loader_;
    const SolvedTexels& solved_;
    const AlbedoOptions& options_;
    PageLayers layers_;
    std::vector<uint8_t> covered_;
    AreaOfDoubts areas_;
    bool ofVertices_;
    bool clips_;
    TextureNoise noise_;
};

LayerMaker::LayerMaker(const Texels& texels, size_t page, const SolvedTexels& solved,
                       const AlbedoOptions& options)
    : page_(page), texels_(texels.pages[page]), loader_(texels, page, &solved.linearization),
      solved_(solved), options_(options), ofVertices_(texels.scan->pages[page].ofVertices),
      clips_(texels.scan->pages[page].image.clipsAtWhite),
      noise_(textureNoiseOf(texels.scan->pages[page].image, solved.linearization.response))
{
    const Image& image = texels.scan->pages[page].image;
    layers_ = emptyLayers(image);
    layers_.emission.resize(3 * image.pixels());
    covered_.resize(image.pixels());
}

/// What is enclosed has its light by what it shows (letRimsIn()), and nothing else is asked.
float LayerMaker::doubtOf(uint32_t surfel) const
{
    const bool isEnclosed = !solved_.rims.empty() && solved_.rims[surfel].albedo > 0.0f;
    return isEnclosed || solved_.doubt.empty() ? 0.0f : solved_.doubt[surfel];
}

/// What is burnt out, hidden by noise, whiter than paper or in doubtful light, and if asked for
/// what is unlit, follows the surface around. Returns how many times the shading its light is.
glm::vec3 LayerMaker::fillChannels(glm::vec3 shown, glm::vec3 burntOut, glm::vec3 shading,
                                   uint32_t surfel, float lack, uint16_t* rho) const
{
    const glm::vec3 around = solved_.fill[surfel];
    const UnknownChannels unknown{
        .burntOut = burntOut,
        .hidden = hiddenWhereLit(shown, shading, options_.darkest, noise_),
        .noise = noiseOfAlbedo(shading, lack, solved_.linearization.whiteOf(surfel), noise_),
        .isUnlit = options_.fill ? glm::lessThan(shading, glm::vec3(options_.darkest))
                                 : glm::bvec3(false)};
    const float doubt = doubtOf(surfel);
    if (!isAnyUnknown(unknown) && lack == 1.0f && doubt < kSureOfPaint) return glm::vec3(1.0f);
    const glm::vec3 own(floatFromHalf(rho[0]), floatFromHalf(rho[1]), floatFromHalf(rho[2]));
    const glm::vec3 believed =
        drawnToPaint(believedUnderLack(own, lack, around, unknown.burntOut), around, doubt,
                     unknown.burntOut, shading, options_.darkest);
    const glm::vec3 filled = filledAlbedo(believed, lack, around, unknown);
    for (int c = 0; c < 3; ++c) rho[c] = halfFromFloat(filled[c]);
    return lackOfChannels(own, lack, believed);
}

void LayerMaker::storeTexel(const TexelBlock& block, const ShadingBlock& shade,
                            const AlbedoBlock& albedo, size_t i, uint32_t pixel)
{
    covered_[pixel] = 1;
    const glm::vec3 radiance(block.r[i], block.g[i], block.b[i]);
    const glm::vec3 shown = radiance / solved_.linearization.whiteOf(block.surfel[i]);
    uint16_t* rho = &layers_.albedo[3 * size_t{pixel}];
    glm::vec3 lack(albedo.lack[i]);
    const auto storeLight = [&] {
        storeRgb(layers_.direct, pixel, shade.direct, i, lack);
        storeRgb(layers_.indirect, pixel, shade.indirect, i, lack);
    };
    const Shining& shining = solved_.shining;
    if (shining.surfels[block.surfel[i]] &&
        (isEmitting(shown, clips_, shining.threshold) ||
         isGlowing(radiance, shining.glowsFromOf(block.surfel[i])))) {
        std::fill(rho, rho + 3, halfFromFloat(kAlbedoOfFixtures));
        storeEmission(radiance, pixel, layers_.emission);
        layers_.doubt[pixel] = Doubt::shines; // confidence stays 0
        storeLight();
        return;
    }
    rho[0] = albedo.r[i];
    rho[1] = albedo.g[i];
    rho[2] = albedo.b[i];
    const glm::vec3 total(shade.direct.r[i] + shade.indirect.r[i],
                          shade.direct.g[i] + shade.indirect.g[i],
                          shade.direct.b[i] + shade.indirect.b[i]);
    const glm::vec3 burntOut = burntOutShares(shown, clips_);
    const Confidence confidence =
        confidenceOf(radiance, brightestChannel(burntOut), total, options_.darkest,
                     solved_.trust.empty() ? SurfelTrust{} : solved_.trust[block.surfel[i]],
                     hiddenShare(brightestChannel(shown), noise_));
    layers_.confidence[pixel] = confidence.byte();
    layers_.doubt[pixel] = confidence.doubt;
    if (!texels_.isShared.empty() && texels_.isShared[pixel]) doubtShared(pixel, layers_);
    if (!solved_.fill.empty())
        lack = fillChannels(shown, burntOut, total, block.surfel[i], albedo.lack[i], rho);
    storeLight();
}

void LayerMaker::makeBlock(size_t begin, size_t count)
{
    TexelBlock block;
    ShadingBlock shading;
    AlbedoBlock albedo;
    loader_.load(begin, count, block);
    loader_.loadSurfel(begin, count, block);
    solved_.shade(page_, begin, block, shading);
    if (!solved_.rims.empty()) letRimsIn(solved_.rims, block, shading);
    temper(solved_.tempering, count, shading);
    divide(block, shading, options_.darkest, albedo);
    loader_.loadArea(begin, count, block);
    for (size_t i = 0; i < count; ++i)
        storeTexel(block, shading, albedo, i, texels_.pixel[begin + i]);
    areas_.add(block, std::span(texels_.pixel).subspan(begin, count), layers_.doubt);
}

void LayerMaker::fillPadding()
{
    if (ofVertices_) return; // its pixels have no neighbours
    for (auto* layer : {&layers_.albedo, &layers_.direct, &layers_.indirect})
        relamp::fillPadding(std::span(*layer), covered_, layers_.width, layers_.height);
    if (!layers_.emission.empty())
        relamp::fillPadding(std::span(layers_.emission), covered_, layers_.width, layers_.height);
}

PageLayers LayerMaker::run(Progress::Stage& stage)
{
    forEachBlock(texels_, [&](size_t begin, size_t count) {
        makeBlock(begin, count);
        stage.advance(count);
    });
    dropDarkEmission(layers_);
    layers_.area = areas_.sum();
    fillPadding();
    return std::move(layers_);
}

} // namespace

PageLayers makeLayers(const Texels& texels, size_t page, const SolvedTexels& solved,
                      const AlbedoOptions& options, Progress& progress)
{
    Progress::Stage stage(progress, "divide", texels.pages[page].count());
    return LayerMaker(texels, page, solved, options).run(stage);
}

} // namespace relamp
