#include "albedo/page_layers_gpu.h"

#include "albedo/layer_parts.h"
#include "albedo/page_layers.comp.h"
#include "base/parallel.h"
#include "image/padding.h"
#include "image/texture_noise.h"

#include <algorithm>
#include <atomic>
#include <vector>

namespace relamp
{
namespace
{

constexpr size_t kPixels = 65536; // in a row, to one thread
constexpr float kMostGlow = 1e6f; // luminance that no half reaches

/// As halfFromFloat() makes them: nothing subnormal, nothing negative.
uint16_t plainHalf(uint32_t half)
{
    return static_cast<uint16_t>(half < 0x400u || half >= 0x8000u ? 0u : half);
}

void unpack(const GpuPicture& picture, std::vector<uint16_t>& rgb)
{
    const std::vector<glm::uvec2> pixels = picture.pixels().download();
    forEachChunk(pixels.size(), kPixels, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            rgb[3 * i] = plainHalf(pixels[i].x & 0xffffu);
            rgb[3 * i + 1] = plainHalf(pixels[i].x >> 16);
            rgb[3 * i + 2] = plainHalf(pixels[i].y & 0xffffu);
        }
    });
}

/// Whether any texel shines.
bool unpackRating(const gpu::Array<uint32_t>& rating, PageLayers& layers)
{
    const std::vector<uint32_t> pixels = rating.download();
    std::atomic<bool> anyShines = false;
    forEachChunk(pixels.size(), kPixels, [&](size_t begin, size_t end) {
        bool shines = false;
        for (size_t i = begin; i < end; ++i) {
            layers.confidence[i] = static_cast<uint8_t>(pixels[i] & 255u);
            layers.doubt[i] = static_cast<Doubt>(pixels[i] >> 8);
            shines |= layers.doubt[i] == Doubt::shines;
        }
        if (shines) anyShines = true;
    });
    return anyShines;
}

/// Sets what follows from the texture and the doubts.
void addEmissionAndAreas(const Texels& texels, size_t p, const Linearization& linearization,
                         bool anyShines, PageLayers& layers)
{
    const PageTexels& page = texels.pages[p];
    const TexelLoader loader(texels, p, &linearization);
    const auto shines = [&](uint32_t pixel) { return layers.doubt[pixel] == Doubt::shines; };
    if (anyShines) layers.emission.resize(3 * layers.doubt.size());
    AreaOfDoubts areas;
    forEachBlock(page, [&](size_t begin, size_t count) {
        TexelBlock block;
        loader.loadArea(begin, count, block);
        const std::span pixels = std::span(page.pixel).subspan(begin, count);
        areas.add(block, pixels, layers.doubt);
        if (!anyShines || std::none_of(pixels.begin(), pixels.end(), shines)) return;
        loader.loadRadiance(begin, count, block);
        for (size_t i = 0; i < count; ++i)
            if (shines(pixels[i]))
                storeEmission({block.r[i], block.g[i], block.b[i]}, pixels[i], layers.emission);
    });
    layers.area = areas.sum();
    dropDarkEmission(layers);
    if (layers.emission.empty() || texels.scan->pages[p].ofVertices) return;
    std::vector<uint8_t> covered(layers.doubt.size());
    for (const uint32_t pixel : page.pixel) covered[pixel] = 1;
    fillPadding(std::span(layers.emission), covered, layers.width, layers.height);
}

} // namespace

LayerPictures::LayerPictures(const gpu::Device& device, uint32_t width, uint32_t height)
    : albedo(device, width, height), direct(device, width, height), indirect(device, width, height),
      rating(device, size_t{width} * height)
{
    gpu::Commands commands(device);
    commands.clear(rating.buffer());
    commands.run();
}

void LayerPictures::clear(gpu::Commands& commands) const
{
    for (const GpuPicture* picture : {&albedo, &direct, &indirect}) picture->clear(commands);
    commands.clear(rating.buffer()); // where no texel is, nothing is said
    commands.barrier();
}

size_t LayerPictures::bytesOf(size_t pixels)
{
    return 3 * GpuPicture::bytesOf(pixels) + pixels * sizeof(uint32_t);
}

PageLayersGpu::PageLayersGpu(const gpu::Device& device, size_t surfels)
    : program_(device, kPageLayersSpirv), rims_(device, surfels), trust_(device, surfels),
      around_(device, surfels), white_(device, surfels), constants_(device, 1)
{}

void PageLayersGpu::setSurfels(const SolvedTexels& solved)
{
    const size_t count = rims_.count();
    std::vector<glm::vec4> rims(count, glm::vec4(0.0f));
    std::vector<glm::vec4> trust(count, glm::vec4(1.0f));
    std::vector<glm::vec4> around(count, glm::vec4(0.0f));
    std::vector<glm::vec4> white(count);
    for (size_t s = 0; s < solved.rims.size(); ++s)
        rims[s] = glm::vec4(solved.rims[s].shading, solved.rims[s].albedo);
    for (size_t s = 0; s < solved.trust.size(); ++s)
        trust[s] = {solved.trust[s].seen, solved.trust[s].front, solved.trust[s].edges,
                    solved.trust[s].proven};
    for (size_t s = 0; s < solved.fill.size(); ++s) around[s] = glm::vec4(solved.fill[s], 0.0f);
    for (size_t s = 0; s < count; ++s)
        if (solved.shining.surfels[s] != 0)
            around[s].w = kOfLamp + std::min(solved.shining.glowsFromOf(s), kMostGlow);
    for (size_t s = 0; s < count; ++s)
        white[s] = glm::vec4(solved.linearization.whiteOf(s),
                             solved.doubt.empty() ? 0.0f : solved.doubt[s]);
    rims_.upload(rims);
    trust_.upload(trust);
    around_.upload(around);
    white_.upload(white);
    tempering_ = glm::vec4(factorOf(solved.tempering), solved.tempering.power);
    threshold_ = solved.shining.threshold;
    linearization_ = solved.linearization;
    fills_ = !solved.fill.empty();
}

void PageLayersGpu::divide(gpu::Commands& commands, const LitPage& page,
                           const AlbedoOptions& options, const LayerPictures& out)
{
    const PageConstants constants{.noise = textureNoiseOf(page.image, linearization_.response),
                                  .threshold = threshold_,
                                  .tempering = tempering_};
    constants_.upload({&constants, 1});
    const uint32_t flags = (page.image.clipsAtWhite ? kClips : 0u) | (fills_ ? kFills : 0u) |
                           (options.fill ? kFillsUnlit : 0u);
    commands.dispatch(program_, page.texels.count,
                      PageLayersArguments{.radiance = page.texels.radiance.ref(),
                                          .direct = page.direct.ref(),
                                          .indirect = page.indirect.ref(),
                                          .surfel = page.texels.surfel.ref(),
                                          .pixel = page.texels.pixel.ref(),
                                          .rims = rims_.ref(),
                                          .trust = trust_.ref(),
                                          .around = around_.ref(),
                                          .white = white_.ref(),
                                          .albedoOut = out.albedo.pixels().ref(),
                                          .directOut = out.direct.pixels().ref(),
                                          .indirectOut = out.indirect.pixels().ref(),
                                          .ratingOut = out.rating.ref(),
                                          .constants = constants_.ref(),
                                          .darkest = options.darkest,
                                          .flags = flags,
                                          .count = static_cast<uint32_t>(page.texels.count)});
    commands.barrier();
}

PageLayers layersFrom(const LayerPictures& pictures, const Texels& texels, size_t page,
                      const Linearization& linearization)
{
    PageLayers layers = emptyLayers(texels.scan->pages[page].image);
    unpack(pictures.albedo, layers.albedo);
    unpack(pictures.direct, layers.direct);
    unpack(pictures.indirect, layers.indirect);
    const bool anyShines = unpackRating(pictures.rating, layers);
    const std::vector<bool>& isShared = texels.pages[page].isShared;
    for (uint32_t pixel = 0; pixel < isShared.size(); ++pixel)
        if (isShared[pixel] && layers.doubt[pixel] != Doubt::shines) doubtShared(pixel, layers);
    addEmissionAndAreas(texels, page, linearization, anyShines, layers);
    return layers;
}

} // namespace relamp
