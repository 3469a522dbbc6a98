#include "rooms/photograph.h"

#include "image/transfer.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace relamp::rooms
{
namespace
{

constexpr float kBalanced = 0.6f; // of a colour cast, in octaves, that white balance takes off
constexpr int kRim = 1;           // pixels of a chart that are not scored
constexpr glm::vec3 kLuminance{0.2126f, 0.7152f, 0.0722f};

/// Calls `work(pixel, nearest pixel of the chart)` for a chart and `around` pixels about it.
template<class Work>
void forPixelsOf(const Atlas& atlas, const Chart& chart, int around, const Work& work)
{
    const auto pixel = [&](glm::ivec2 at) { return static_cast<size_t>(at.y * atlas.side + at.x); };
    const glm::ivec2 end = chart.corner + chart.pixels;
    for (int y = chart.corner.y - around; y < end.y + around; ++y)
        for (int x = chart.corner.x - around; x < end.x + around; ++x)
            work(pixel({x, y}), pixel(glm::clamp(glm::ivec2(x, y), chart.corner, end - 1)));
}

std::vector<uint8_t> scored(const Atlas& atlas, const Baked& baked)
{
    std::vector<uint8_t> mask(atlas.pixels(), 0);
    for (const Chart& chart : atlas.charts)
        if (chart.patch.lamp < 0)
            forPixelsOf(atlas, chart, -kRim, [&](size_t pixel, size_t) {
                mask[pixel] = baked.isHidden[pixel] != 0 ? 0 : 255;
            });
    return mask;
}

glm::vec3 exposed(const Baked& baked, const std::vector<uint8_t>& mask, float burntOut)
{
    std::vector<glm::vec3> radiances;
    glm::dvec3 mean(0.0);
    for (size_t p = 0; p < mask.size(); ++p)
        if (mask[p] != 0) {
            radiances.push_back(baked.radiance(p));
            mean += glm::dvec3(radiances.back());
        }
    const auto cast = glm::vec3(mean / glm::dot(mean, glm::dvec3(kLuminance)));
    const glm::vec3 balance = glm::pow(cast, glm::vec3(-kBalanced));
    std::vector<float> brightest;
    for (const glm::vec3& radiance : radiances) {
        const glm::vec3 seen = balance * radiance;
        brightest.push_back(std::max({seen.r, seen.g, seen.b}));
    }
    const auto burns =
        static_cast<ptrdiff_t>((1.0f - burntOut) * static_cast<float>(brightest.size()));
    std::nth_element(brightest.begin(), brightest.begin() + burns, brightest.end());
    return balance / brightest[static_cast<size_t>(burns)];
}

} // namespace

Photograph photograph(const Atlas& atlas, const Baked& baked, float burntOut)
{
    Photograph result;
    result.mask = scored(atlas, baked);
    result.scale = exposed(baked, result.mask, burntOut);
    result.seen.assign(atlas.pixels(), glm::vec3(0.0f));
    result.encoded.assign(3 * atlas.pixels(), 0);
    for (const Chart& chart : atlas.charts)
        forPixelsOf(atlas, chart, kPadding, [&](size_t pixel, size_t from) {
            result.seen[pixel] = result.scale * baked.radiance(from);
            const glm::vec3 shown = glm::clamp(result.seen[pixel], 0.0f, 1.0f);
            for (int c = 0; c < 3; ++c)
                result.encoded[3 * pixel + static_cast<size_t>(c)] = srgbByteFromLinear(shown[c]);
        });
    return result;
}

} // namespace relamp::rooms
