#include "albedo/layer_parts.h"

#include "image/transfer.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

constexpr uint8_t kConfidenceOfShared = 64; // of 255: one place in four may be right
constexpr double kUnitsOfArea = 1e9; // a square metre; a thousandth of a square millimetre is one

} // namespace

PageLayers emptyLayers(const Image& image)
{
    PageLayers layers{.width = image.width, .height = image.height};
    for (auto* layer : {&layers.albedo, &layers.direct, &layers.indirect})
        layer->resize(3 * image.pixels());
    layers.confidence.resize(image.pixels());
    layers.doubt.resize(image.pixels());
    return layers;
}

void storeEmission(glm::vec3 radiance, uint32_t pixel, std::vector<uint8_t>& emission)
{
    for (int c = 0; c < 3; ++c)
        emission[3 * size_t{pixel} + static_cast<size_t>(c)] = srgbByteFromLinear(radiance[c]);
}

void dropDarkEmission(PageLayers& layers)
{
    const auto isDark = [](uint8_t value) { return value == 0; };
    if (std::all_of(layers.emission.begin(), layers.emission.end(), isDark)) layers.emission = {};
}

void doubtShared(uint32_t pixel, PageLayers& layers)
{
    uint8_t& confidence = layers.confidence[pixel];
    if (confidence > kConfidenceOfShared) layers.doubt[pixel] = Doubt::shared;
    confidence = static_cast<uint8_t>(confidence * kConfidenceOfShared / 255);
}

/// Whole numbers, whose sum does not depend on their order.
void AreaOfDoubts::add(const TexelBlock& block, std::span<const uint32_t> pixels,
                       std::span<const Doubt> doubtOfPixels)
{
    std::array<double, kDoubts> area{};
    for (size_t i = 0; i < block.count; ++i)
        area[static_cast<size_t>(doubtOfPixels[pixels[i]])] += static_cast<double>(block.area[i]);
    for (size_t d = 0; d < kDoubts; ++d)
        area_[d] += static_cast<uint64_t>(std::llround(kUnitsOfArea * area[d]));
}

std::array<double, kDoubts> AreaOfDoubts::sum() const
{
    std::array<double, kDoubts> sum{};
    for (size_t d = 0; d < kDoubts; ++d)
        sum[d] = static_cast<double>(area_[d].load()) / kUnitsOfArea;
    return sum;
}

} // namespace relamp
