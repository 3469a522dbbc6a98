#include "fit/shade.h"

#include "lights/expand.shared.h"
#include "shading/gathered_light.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace relamp
{
namespace
{

constexpr float kPi = 3.14159265f;
constexpr float kBeside = 1.6f;        // surfel sizes
constexpr float kMostBurntOut = 0.1f;  // of a surfel
constexpr float kPaintStep = 0.2f;     // of log albedo between neighbours: more is an edge of paint
constexpr float kColorStep = 0.1f;     // of log (r / g) and log (b / g), likewise
constexpr float kBelief = 0.01f;       // in the light found in the middle of all places
constexpr int kSweeps = 40;
constexpr float kDarkest = 1e-4f;

/// Albedo as the light found makes it, in logarithms.
struct Paint
{
    float brightness;
    float red;  // over green
    float blue; // over green
    float belief; // in the light; < 0: nothing is known here
};

float logOf(float value)
{
    return std::log(std::max(value, kDarkest));
}

std::vector<Paint> paintOf(const SurfelRadiance& radiance, std::span<const glm::vec3> irradiance)
{
    std::vector<float> found;
    for (const glm::vec3 light : irradiance) found.push_back(luminance(light));
    const auto middle = found.begin() + static_cast<ptrdiff_t>(found.size() / 2);
    std::nth_element(found.begin(), middle, found.end());
    const float usual = std::max(*middle, kDarkest);
    std::vector<Paint> paint;
    for (size_t s = 0; s < irradiance.size(); ++s) {
        const glm::vec3 seen = radiance.plain[s];
        const glm::vec3 light = irradiance[s];
        const float green = logOf(seen.g) - logOf(light.g);
        const float bright = luminance(light) / usual;
        const bool isKnown = radiance.plainArea[s] > 0.0f &&
                             radiance.clippedArea[s] < kMostBurntOut * radiance.plainArea[s];
        paint.push_back({logOf(luminance(seen)) - logOf(luminance(light)),
                         logOf(seen.r) - logOf(light.r) - green,
                         logOf(seen.b) - logOf(light.b) - green,
                         isKnown ? kBelief * bright * bright * bright : -1.0f});
    }
    return paint;
}

/// How alike two neighbours' paint is, by colour: 0..1.
float alike(const Paint& a, const Paint& b)
{
    const float red = (a.red - b.red) / kColorStep;
    const float blue = (a.blue - b.blue) / kColorStep;
    const float far = 1.0f + red * red + blue * blue;
    return 1.0f / (far * far);
}

/// The log of the light that is there over that which was found, such that paint is even but for
/// edges and light stays where it is believed: one step for one surfel.
float settled(const Surfels& surfels, std::span<const Paint> paint, std::span<const float> lit,
              size_t s)
{
    float sum = 0.0f;
    float weights = 0.0f;
    float count = 0.0f;
    for (const uint32_t n : surfels.neighborsOf(s)) {
        if (n == s || paint[n].belief < 0.0f) continue;
        const glm::vec3 way = surfels.position[n] - surfels.position[s];
        if (glm::dot(way, way) > kBeside * kBeside * surfels.size * surfels.size) continue;
        const float even = lit[n] + paint[s].brightness - paint[n].brightness;
        const float step = (even - lit[s]) / kPaintStep;
        const float weight = alike(paint[s], paint[n]) / (1.0f + step * step);
        sum += weight * even;
        weights += weight;
        count += 1.0f;
    }
    return count > 0.0f ? sum / (weights + paint[s].belief * count) : 0.0f;
}

} // namespace

std::vector<float> findShade(const Surfels& surfels, const SurfelRadiance& radiance,
                             std::span<const glm::vec3> irradiance)
{
    const std::vector<Paint> paint = paintOf(radiance, irradiance);
    std::vector<float> lit(surfels.count(), 0.0f);
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (size_t i = 0; i < lit.size(); ++i) {
            const size_t s = sweep % 2 == 0 ? i : lit.size() - 1 - i;
            if (paint[s].belief >= 0.0f) lit[s] = settled(surfels, paint, lit, s);
        }
    for (float& log : lit) log = std::exp(std::min(log, 0.0f));
    return lit;
}

TexelShading withShade(const Texels& texels, TexelShading shade, std::vector<float> lit)
{
    std::vector<glm::vec3> shares;
    for (const float share : lit) shares.emplace_back(kPi * share);
    return [&texels, shade = std::move(shade),
            shares = std::make_shared<const std::vector<glm::vec3>>(std::move(shares))](
               size_t page, size_t begin, const TexelBlock& block, ShadingBlock& out) {
        shade(page, begin, block, out);
        RgbBlock share;
        interpolate(texels, *shares, page, begin, block, share);
        for (RgbBlock* part : {&out.direct, &out.indirect})
            for (float* channel : {part->r, part->g, part->b})
                for (size_t i = 0; i < block.count; ++i) channel[i] *= share.r[i];
    };
}

} // namespace relamp
