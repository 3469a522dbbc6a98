#include "image/chroma.h"

#include "base/instruction_set.h"
#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace relamp
{
namespace
{

constexpr int kReach = 2; // pixels: a decoder's triangle filter spreads a stored colour that far
constexpr size_t kSide = 2 * kReach + 1;
constexpr int kMargin = kReach + 1; // for those, the pixels beside
constexpr float kPlaceDeviation = 1.5f;
constexpr size_t kRows = 32; // of a chunk
// Brightness, of 255, between pixels of different paint: above JPEG's noise, below most edges.
constexpr float kEdge = 2.5f * 0.03f * 255.0f;
// Deviation of it around a pixel whose stored colour may be a mixture.
constexpr float kUneven = 0.03f * 255.0f;
constexpr float kLeastTrust = 1e-3f;
// In black a ratio would be noise.
constexpr float kDark = 0.05f * 255.0f;
// Where a channel may be burnt out, the ratios are wrong: such a pixel neither gives nor takes.
constexpr uint8_t kBurning = 250;

/// Rows of a picture, with kMargin pixels more on each side, as brightness and colour ratios.
struct Strip
{
    explicit Strip(size_t width)
        : stride(width + 2 * kMargin), y(stride * (kRows + 2 * kMargin)), cb(y.size()),
          cr(y.size()), counts(y.size()), trust(y.size())
    {}

    size_t stride;
    std::vector<float> y;
    std::vector<float> cb;     // (B - Y) / (Y + kDark)
    std::vector<float> cr;     // (R - Y) / (Y + kDark)
    std::vector<float> counts; // 0 where a channel may be burnt out, else 1
    std::vector<float> trust;  // 0..1: in its colour's being of one paint; all but the rim
};

/// Rec. 601, JPEG's.
float brightness(float r, float g, float b)
{
    return 0.299f * r + 0.587f * g + 0.114f * b;
}

/// Row `row` of a picture, the nearest that there is, into row `to` of the strip.
void load(std::span<const uint8_t> rgb, int width, int height, int row, size_t to, Strip& strip)
{
    const auto from = static_cast<size_t>(std::clamp(row, 0, height - 1) * int64_t{width});
    for (size_t i = 0; i < strip.stride; ++i) {
        const int column = std::clamp(static_cast<int>(i) - kMargin, 0, width - 1);
        const uint8_t* pixel = &rgb[3 * (from + static_cast<size_t>(column))];
        const float y = brightness(pixel[0], pixel[1], pixel[2]);
        const float scale = 1.0f / (y + kDark);
        const size_t at = to * strip.stride + i;
        strip.y[at] = y;
        strip.cb[at] = (static_cast<float>(pixel[2]) - y) * scale;
        strip.cr[at] = (static_cast<float>(pixel[0]) - y) * scale;
        strip.counts[at] = std::max({pixel[0], pixel[1], pixel[2]}) < kBurning ? 1.0f : 0.0f;
    }
}

/// Whether a pixel's stored colour is of one paint: where brightness is even around it.
void judgeRow(Strip& strip, size_t row)
{
    const size_t begin = row * strip.stride;
    for (size_t at = begin + 1; at + 1 < begin + strip.stride; ++at) {
        float sum = 0.0f;
        float squares = 0.0f;
        for (size_t j = 0; j < 3; ++j)
            for (size_t i = 0; i < 3; ++i) {
                const float step =
                    strip.y[at + j * strip.stride + i - strip.stride - 1] - strip.y[at];
                sum += step;
                squares += step * step;
            }
        const float variance = squares / 9.0f - sum * sum / 81.0f;
        const float even = 1.0f / (1.0f + variance * (1.0f / (kUneven * kUneven)));
        strip.trust[at] = strip.counts[at] * (even * even + kLeastTrust);
    }
}

/// Gaussian over the places of the 5 x 5 pixels.
std::array<float, kSide * kSide> placeWeights()
{
    std::array<float, kSide * kSide> weights{};
    for (size_t i = 0; i < weights.size(); ++i) {
        const float x = static_cast<float>(i % kSide) - kReach;
        const float y = static_cast<float>(i / kSide) - kReach;
        weights[i] = std::exp(-0.5f * (x * x + y * y) / (kPlaceDeviation * kPlaceDeviation));
    }
    return weights;
}

/// A channel back from its difference to the brightness, rounded.
uint8_t channel(float value)
{
    return static_cast<uint8_t>(std::clamp(value, 0.0f, 255.0f) + 0.5f);
}

/// Row `row` of the strip's inner ones, as colour.
void sharpenRow(const Strip& strip, size_t row, const std::array<float, kSide * kSide>& place,
                std::span<uint8_t> rgb)
{
    const size_t width = rgb.size() / 3;
    const size_t first = (row + kMargin) * strip.stride + kMargin;
    for (size_t x = 0; x < width; ++x) {
        const size_t center = first + x;
        const float y = strip.y[center];
        const float counts = strip.counts[center];
        float sum = 1.0f - counts; // what does not count keeps its own colour
        float cb = sum * strip.cb[center];
        float cr = sum * strip.cr[center];
        for (size_t j = 0; j < kSide; ++j)
            for (size_t i = 0; i < kSide; ++i) {
                const size_t at = center + (j - kReach) * strip.stride + i - kReach;
                const float step = (strip.y[at] - y) * (1.0f / kEdge);
                const float alike = std::max(1.0f - step * step, 0.0f);
                const float weight =
                    counts * strip.trust[at] * place[j * kSide + i] * alike * alike;
                sum += weight;
                cb += weight * strip.cb[at];
                cr += weight * strip.cr[at];
            }
        const float scale = (y + kDark) / sum; // the pixel itself has some weight
        const float red = y + cr * scale;
        const float blue = y + cb * scale;
        const float green = (y - 0.299f * red - 0.114f * blue) * (1.0f / 0.587f);
        rgb[3 * x + 0] = channel(red);
        rgb[3 * x + 1] = channel(green);
        rgb[3 * x + 2] = channel(blue);
    }
}

} // namespace

void sharpenChroma(std::span<uint8_t> rgb, int width, int height)
{
    const auto columns = static_cast<size_t>(width);
    const auto place = placeWeights();
    const std::vector<uint8_t> from(rgb.begin(), rgb.end());
    const InstructionSet set = bestInstructionSet();
    forEachChunk(static_cast<size_t>(height), kRows, [&](size_t begin, size_t end) {
        Strip strip(columns);
        const size_t rows = end - begin + 2 * kMargin;
        for (size_t row = 0; row < rows; ++row)
            load(from, width, height, static_cast<int>(begin + row) - kMargin, row, strip);
        for (size_t row = 1; row + 1 < rows; ++row) runKernel<judgeRow>(set, strip, row);
        for (size_t row = 0; row < end - begin; ++row) {
            auto to = rgb.subspan(3 * columns * (begin + row), 3 * columns);
            runKernel<sharpenRow>(set, strip, row, place, to);
        }
    });
}

} // namespace relamp
