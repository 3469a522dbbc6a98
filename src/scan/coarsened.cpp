#include "scan/coarsened.h"

#include "base/half.h"
#include "base/parallel.h"
#include "image/transfer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace relamp
{
namespace
{

/// Blocks of pixels that become one: `factor` along each side, fewer where the picture ends.
class Blocks
{
public:
    Blocks(const Image& image, int factor) : image_(image), factor_(factor) {}

    [[nodiscard]] int width() const { return (image_.width + factor_ - 1) / factor_; }
    [[nodiscard]] int height() const { return (image_.height + factor_ - 1) / factor_; }

    /// Mean of `valueOf(pixel)` over the block of a pixel of the small picture.
    template<class Value, class ValueOf>
    [[nodiscard]] Value mean(size_t small, const ValueOf& valueOf) const
    {
        const int x = factor_ * static_cast<int>(small % static_cast<size_t>(width()));
        const int y = factor_ * static_cast<int>(small / static_cast<size_t>(width()));
        const int right = std::min(x + factor_, image_.width);
        const int bottom = std::min(y + factor_, image_.height);
        Value sum(0.0f);
        for (int row = y; row < bottom; ++row)
            for (int column = x; column < right; ++column)
                sum += valueOf(static_cast<size_t>(row) * static_cast<size_t>(image_.width) +
                               static_cast<size_t>(column));
        return sum / static_cast<float>((right - x) * (bottom - y));
    }

private:
    const Image& image_;
    int factor_;
};

void putLight(Image& image, size_t pixel, glm::vec3 light)
{
    for (int c = 0; c < 3; ++c) {
        const size_t at = 3 * pixel + static_cast<size_t>(c);
        if (!image.isEncoded())
            image.half()[at] = halfFromFloat(light[c]);
        else if (image.transfer == Transfer::srgb)
            image.encoded()[at] = srgbByteFromLinear(light[c]);
        else
            image.encoded()[at] = static_cast<uint8_t>(std::lround(255.0f * light[c]));
    }
}

Image shrunk(const Image& image, int factor)
{
    const Blocks blocks(image, factor);
    const Radiance radiance(image);
    Image small{.width = blocks.width(),
                .height = blocks.height(),
                .transfer = image.transfer,
                .clipsAtWhite = image.clipsAtWhite,
                .wasJpeg = image.wasJpeg};
    if (image.isEncoded())
        small.rgb = std::vector<uint8_t>(3 * small.pixels());
    else
        small.rgb = std::vector<uint16_t>(3 * small.pixels());
    if (!image.alpha.empty()) small.alpha.resize(small.pixels());
    forEachChunk(small.pixels(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            putLight(small, i, blocks.mean<glm::vec3>(i, [&](size_t at) { return radiance[at]; }));
            if (small.alpha.empty()) continue;
            const auto opacity = [&](size_t at) { return static_cast<float>(image.alpha[at]); };
            small.alpha[i] = static_cast<uint8_t>(std::lround(blocks.mean<float>(i, opacity)));
        }
    });
    return small;
}

} // namespace

int coarseFactor(const Page& page, int longestSide)
{
    assert(longestSide >= 1);
    int factor = 1;
    while (!page.ofVertices && std::max(page.image.width, page.image.height) > longestSide * factor)
        factor *= 2;
    return factor;
}

Scan coarsened(Scan scan, int longestSide)
{
    for (Page& page : scan.pages)
        if (const int factor = coarseFactor(page, longestSide); factor > 1)
            page.image = shrunk(page.image, factor);
    int& limit = scan.options.longestSide; // whoever reads the scan again gets the same textures
    limit = limit > 0 ? std::min(limit, longestSide) : longestSide;
    return scan;
}

Scan coarseCopyOf(const Scan& scan, int longestSide, const std::function<void(size_t)>& seen)
{
    Scan copy{.name = scan.name, .meshes = scan.meshes};
    for (const Page& page : scan.pages) {
        const int factor = coarseFactor(page, longestSide);
        copy.pages.push_back({.name = page.name,
                              .image = factor > 1 ? shrunk(page.image, factor) : page.image,
                              .ofVertices = page.ofVertices});
        if (seen) seen(copy.pages.size() - 1);
    }
    return copy;
}

} // namespace relamp
