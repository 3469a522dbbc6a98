#include "fit/dials.h"

#include "lights/expand.shared.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace relamp
{
namespace
{

constexpr float kBrightestAlbedo = 0.9f;
constexpr float kBrightestShare = 0.98f;
constexpr int kAmbientSteps = 33; // from 1 % to 10 times the mean shading of the lights

struct Weighted
{
    float value;
    float weight;
};

/// Values below which the given shares of all weight lie. Sorts `values`.
float quantile(std::vector<Weighted>& values, float share)
{
    double total = 0.0;
    for (const Weighted& v : values) total += static_cast<double>(v.weight);
    double below = 0.0;
    for (const Weighted& v : values) {
        below += static_cast<double>(v.weight);
        if (below >= static_cast<double>(share) * total) return v.value;
    }
    return values.empty() ? 0.0f : values.back().value;
}

/// log albedo of all samples, ascending.
std::vector<Weighted> logAlbedo(std::span<const DialSample> samples, float ambient)
{
    std::vector<Weighted> values;
    values.reserve(samples.size());
    for (const DialSample& s : samples) {
        const float radiance = luminance(s.radiance);
        const float shading = luminance(s.shading) + ambient;
        if (radiance > 1e-4f && shading > 1e-6f && s.area > 0.0f)
            values.push_back({std::log(radiance / shading), s.area * radiance});
    }
    std::sort(values.begin(), values.end(), [](const Weighted& a, const Weighted& b) {
        return a.value < b.value || (a.value == b.value && a.weight < b.weight);
    });
    return values;
}

float spreadOf(std::span<const DialSample> samples, float ambient)
{
    std::vector<Weighted> values = logAlbedo(samples, ambient);
    return quantile(values, 0.75f) - quantile(values, 0.25f);
}

float meanShading(std::span<const DialSample> samples)
{
    double sum = 0.0;
    double area = 0.0;
    for (const DialSample& s : samples) {
        sum += static_cast<double>(s.area * luminance(s.shading));
        area += static_cast<double>(s.area);
    }
    return area > 0.0 ? static_cast<float>(sum / area) : 0.0f;
}

float evenestAmbient(std::span<const DialSample> samples)
{
    const float mean = meanShading(samples);
    if (mean <= 0.0f) return 1.0f; // no light at all: ambient is all there is
    float best = 0.0f;
    float least = spreadOf(samples, 0.0f);
    for (int i = 0; i < kAmbientSteps; ++i) {
        const float ambient = mean * std::pow(10.0f, -2.0f + 3.0f * static_cast<float>(i) / (kAmbientSteps - 1));
        const float spread = spreadOf(samples, ambient);
        if (spread < least) {
            least = spread;
            best = ambient;
        }
    }
    return best;
}

} // namespace

Dials fitDials(std::span<const DialSample> samples, std::optional<float> ambient)
{
    Dials dials;
    dials.ambient = ambient ? *ambient : evenestAmbient(samples);
    std::vector<Weighted> values = logAlbedo(samples, dials.ambient);
    if (!values.empty()) dials.power = std::exp(quantile(values, kBrightestShare)) / kBrightestAlbedo;
    return dials;
}

} // namespace relamp
