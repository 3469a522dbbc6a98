#include "image/padding.h"

#include "base/half.h"
#include "base/parallel.h"

#include <cassert>
#include <vector>

namespace relamp
{
namespace
{

float valueOf(uint16_t half)
{
    return floatFromHalf(half);
}
float valueOf(uint8_t byte)
{
    return static_cast<float>(byte);
}
void setValue(float value, uint16_t& half)
{
    half = halfFromFloat(value);
}
void setValue(float value, uint8_t& byte)
{
    byte = static_cast<uint8_t>(value + 0.5f);
}

template<class Sample>
struct Level
{
    std::span<Sample> rgb;
    std::span<const uint8_t> covered;
    size_t width;
    size_t height;
};

template<class Sample>
struct OwnedLevel
{
    std::vector<Sample> rgb;
    std::vector<uint8_t> covered;
    size_t width;
    size_t height;

    Level<Sample> view() { return {rgb, covered, width, height}; }
};

/// The next mip level: means of the covered among four pixels.
template<class Sample>
OwnedLevel<Sample> push(const Level<Sample>& fine)
{
    OwnedLevel<Sample> coarse{{}, {}, (fine.width + 1) / 2, (fine.height + 1) / 2};
    coarse.rgb.resize(3 * coarse.width * coarse.height);
    coarse.covered.resize(coarse.width * coarse.height);
    forEachChunk(coarse.height, 16, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (size_t x = 0; x < coarse.width; ++x) {
                float sum[3] = {};
                float count = 0.0f;
                for (size_t k = 0; k < 4; ++k) {
                    const size_t fx = 2 * x + k % 2;
                    const size_t fy = 2 * y + k / 2;
                    if (fx >= fine.width || fy >= fine.height ||
                        !fine.covered[fy * fine.width + fx])
                        continue;
                    for (size_t c = 0; c < 3; ++c)
                        sum[c] += valueOf(fine.rgb[3 * (fy * fine.width + fx) + c]);
                    count += 1.0f;
                }
                if (count == 0.0f) continue;
                coarse.covered[y * coarse.width + x] = 1;
                for (size_t c = 0; c < 3; ++c)
                    setValue(sum[c] / count, coarse.rgb[3 * (y * coarse.width + x) + c]);
            }
    });
    return coarse;
}

/// Fills what is not covered of the finer level from the coarser.
template<class Sample>
void pull(const Level<Sample>& coarse, const Level<Sample>& fine)
{
    forEachChunk(fine.height, 16, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (size_t x = 0; x < fine.width; ++x) {
                if (fine.covered[y * fine.width + x]) continue;
                const size_t from = 3 * (y / 2 * coarse.width + x / 2);
                const size_t to = 3 * (y * fine.width + x);
                for (size_t c = 0; c < 3; ++c) fine.rgb[to + c] = coarse.rgb[from + c];
            }
    });
}

template<class Sample>
void pushPull(const Level<Sample>& finest)
{
    assert(finest.rgb.size() == 3 * finest.width * finest.height);
    std::vector<OwnedLevel<Sample>> levels;
    Level<Sample> top = finest;
    while (top.width > 1 || top.height > 1) {
        levels.push_back(push(top));
        top = levels.back().view();
    }
    for (size_t i = levels.size(); i-- > 0;)
        pull(levels[i].view(), i == 0 ? finest : levels[i - 1].view());
}

} // namespace

void fillPadding(std::span<uint16_t> rgb, std::span<const uint8_t> covered, int width, int height)
{
    pushPull<uint16_t>({rgb, covered, static_cast<size_t>(width), static_cast<size_t>(height)});
}

void fillPadding(std::span<uint8_t> rgb, std::span<const uint8_t> covered, int width, int height)
{
    pushPull<uint8_t>({rgb, covered, static_cast<size_t>(width), static_cast<size_t>(height)});
}

} // namespace relamp
