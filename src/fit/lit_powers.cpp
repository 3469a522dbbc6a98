#include "fit/lit_powers.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"

#include <algorithm>
#include <vector>

namespace relamp
{
namespace
{

constexpr float kDark = 0.5f;     // of the median light
constexpr size_t kLeastPairs = 4; // a quarter of the pairs; of fewer the prior has too much to say

/// Luminance of the irradiance of every measured place.
std::vector<float> lightUnder(const Powers& powers, const FitData& data)
{
    std::vector<float> light(data.places());
    forEachChunk(light.size(), 512, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            glm::vec3 irradiance = data.gathered[i] + data.missed[i] * powers.ambient;
            for (size_t f = 0; f < data.lamps; ++f)
                irradiance += data.direct[i * data.lamps + f] * powers.radiance[f];
            light[i] = luminance(irradiance);
        }
    });
    return light;
}

std::vector<MaterialPair> litPairs(std::span<const MaterialPair> pairs,
                                   std::span<const float> light)
{
    if (light.empty()) return {};
    std::vector<float> sorted(light.begin(), light.end());
    const auto middle = sorted.begin() + static_cast<ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const float least = kDark * *middle;
    std::vector<MaterialPair> lit;
    for (const MaterialPair pair : pairs)
        if (std::min(light[pair.p], light[pair.q]) >= least) lit.push_back(pair);
    return lit;
}

float totalOf(const Powers& powers, std::span<const float> areas)
{
    float total = 0.0f;
    for (size_t f = 0; f < areas.size(); ++f) total += areas[f] * luminance(powers.radiance[f]);
    return total;
}

} // namespace

Powers fitLitPowers(const FitData& data, std::span<const MaterialPair> pairs,
                    std::span<const float> areas, PowersOptions options)
{
    Powers all = fitPowers(data, pairs, options);
    const std::vector<MaterialPair> lit = litPairs(pairs, lightUnder(all, data));
    if (lit.empty() || kLeastPairs * lit.size() < pairs.size()) return all;
    options.start = all.radiance;
    options.start.push_back(all.ambient);
    options.firstScale = 2.0 * options.lastScale; // most of it is known
    Powers ofLit = fitPowers(data, lit, options);
    return totalOf(ofLit, areas) < totalOf(all, areas) ? ofLit : all;
}

} // namespace relamp
