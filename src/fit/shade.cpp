#include "fit/shade.h"

#include "base/parallel.h"
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
constexpr float kBeside = 1.6f;       // surfel sizes
constexpr float kMostBurntOut = 0.1f; // of a surfel
constexpr float kPaintStep = 0.3f;    // of log albedo between neighbours: more is an edge of paint
constexpr float kColorStep = 0.1f;    // of log (r / g) and log (b / g), likewise
constexpr float kBelief = 0.004f;     // in the light found in the middle of all places
constexpr float kMostUneven = 0.05f;  // of log light that is too dark: so much is noise
constexpr int kSweeps = 80;
constexpr float kDarkest = 1e-4f;

/// Albedo as the light found makes it, in logarithms.
struct Paint
{
    float brightness;
    float red;    // over green
    float blue;   // over green
    float belief; // in the light; < 0: nothing is known here
};

float logOf(float value)
{
    return std::log(std::max(value, kDarkest));
}

/// Steep: what is darker than usual by an octave is believed 64 times less.
float beliefIn(float bright)
{
    const float squared = bright * bright;
    return kBelief * squared * squared * squared;
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
                         isKnown ? beliefIn(bright) : -1.0f});
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

/// A neighbour of a surfel.
struct Beside
{
    uint32_t surfel;
    float step;  // of brightness, from it to the surfel
    float alike; // in colour
};

/// Neighbours of all surfels; those of s are beside[first[s]] .. beside[first[s + 1] - 1].
struct Sheet
{
    std::vector<uint32_t> first{0};
    std::vector<Beside> beside;
};

Sheet sheetOf(const Surfels& surfels, std::span<const Paint> paint)
{
    Sheet sheet;
    const float reach = kBeside * surfels.size;
    for (size_t s = 0; s < surfels.count(); ++s) {
        for (const uint32_t n : surfels.neighborsOf(s)) {
            const glm::vec3 way = surfels.position[n] - surfels.position[s];
            if (n == s || paint[s].belief < 0.0f || paint[n].belief < 0.0f ||
                glm::dot(way, way) > reach * reach)
                continue;
            sheet.beside.push_back(
                {n, paint[s].brightness - paint[n].brightness, alike(paint[s], paint[n])});
        }
        sheet.first.push_back(static_cast<uint32_t>(sheet.beside.size()));
    }
    return sheet;
}

/// What a surfel's light comes to beside its neighbours': paint is even but for edges, and light
/// stays where it is believed. Logs of the light that is there over that which was found.
float settled(std::span<const Beside> beside, float belief, std::span<const float> lit, size_t s)
{
    float sum = 0.0f;
    float weights = belief * static_cast<float>(beside.size());
    for (const auto [n, step, alike] : beside) {
        const float even = lit[n] + step;
        const float edge = (even - lit[s]) / kPaintStep;
        const float far = 1.0f + edge * edge;
        const float weight = alike / (far * far);
        sum += weight * even;
        weights += weight;
    }
    return weights > 0.0f ? sum / weights : 0.0f;
}

/// Shares of light, each the mean of a surfel and those around it: what comes and goes from surfel
/// to surfel is a pattern.
std::vector<float> sharesOf(const Sheet& sheet, std::span<const float> lit)
{
    std::vector<float> shares(lit.size());
    forEachChunk(lit.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s) {
            float sum = lit[s];
            float weights = 1.0f;
            for (uint32_t i = sheet.first[s]; i < sheet.first[s + 1]; ++i) {
                const Beside& other = sheet.beside[i];
                sum += other.alike * lit[other.surfel];
                weights += other.alike;
            }
            shares[s] = std::exp(std::min(sum / weights, kMostUneven));
        }
    });
    return shares;
}

} // namespace

std::vector<float> findShade(const Surfels& surfels, const SurfelRadiance& radiance,
                             std::span<const glm::vec3> irradiance)
{
    if (irradiance.empty()) return {};
    const std::vector<Paint> paint = paintOf(radiance, irradiance);
    const Sheet sheet = sheetOf(surfels, paint);
    std::vector<float> lit(surfels.count(), 0.0f);
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (size_t i = 0; i < lit.size(); ++i) {
            const size_t s = sweep % 2 == 0 ? i : lit.size() - 1 - i;
            const std::span beside(sheet.beside.begin() + sheet.first[s],
                                   sheet.beside.begin() + sheet.first[s + 1]);
            if (!beside.empty()) lit[s] = settled(beside, paint[s].belief, lit, s);
        }
    return sharesOf(sheet, lit);
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
