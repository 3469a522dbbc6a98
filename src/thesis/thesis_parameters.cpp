#include "thesis/thesis_parameters.h"

#include "base/radiometry.shared.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace relamp
{
namespace
{

constexpr float kBrightestShare = 0.98f;
constexpr int kAmbientSteps = 33; // from 1 % to 10 times the mean shading of the lights
constexpr int kHalvings = 40;
constexpr float kPowers[] = {1e-4f, 1e4f}; // a power outside is no answer

struct Weighted
{
    float value;
    float weight;
};

/// Value below which a share of all weight lies. `values` are ascending.
float quantile(const std::vector<Weighted>& values, float share)
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

/// log albedo of all samples under given parameters, ascending.
std::vector<Weighted> logAlbedo(std::span<const ParameterSample> samples,
                                const FittedParameters& parameters)
{
    std::vector<Weighted> values;
    values.reserve(samples.size());
    for (const ParameterSample& s : samples) {
        const float radiance = luminance(s.radiance);
        const float shading = parameters.power * luminance(s.shading) + parameters.ambient;
        if (radiance > 1e-4f && shading > 1e-6f && s.area > 0.0f)
            values.push_back({std::log(radiance / shading), s.area * radiance});
    }
    std::sort(values.begin(), values.end(), [](const Weighted& a, const Weighted& b) {
        return a.value < b.value || (a.value == b.value && a.weight < b.weight);
    });
    return values;
}

float spreadOf(std::span<const ParameterSample> samples, const FittedParameters& parameters)
{
    const std::vector<Weighted> values = logAlbedo(samples, parameters);
    return quantile(values, 0.75f) - quantile(values, 0.25f);
}

float brightestAlbedo(std::span<const ParameterSample> samples, const FittedParameters& parameters)
{
    const std::vector<Weighted> values = logAlbedo(samples, parameters);
    return values.empty() ? kWhitePaint : std::exp(quantile(values, kBrightestShare));
}

float meanShading(std::span<const ParameterSample> samples)
{
    double sum = 0.0;
    double area = 0.0;
    for (const ParameterSample& s : samples) {
        sum += static_cast<double>(s.area * luminance(s.shading));
        area += static_cast<double>(s.area);
    }
    return area > 0.0 ? static_cast<float>(sum / area) : 0.0f;
}

/// The ambient that makes the albedo most uniform beside lights of a given power.
float evenestAmbient(std::span<const ParameterSample> samples, float power)
{
    const float mean = power * meanShading(samples);
    if (mean <= 0.0f) return 1.0f; // no light at all: ambient is all there is
    FittedParameters best{power, 0.0f};
    float least = spreadOf(samples, best);
    for (int i = 0; i < kAmbientSteps; ++i) {
        const float ambient =
            mean * std::pow(10.0f, -2.0f + 3.0f * static_cast<float>(i) / (kAmbientSteps - 1));
        const float spread = spreadOf(samples, {power, ambient});
        if (spread < least) {
            least = spread;
            best.ambient = ambient;
        }
    }
    return best.ambient;
}

/// The power that brings the brightest albedo to the anchor beside a given ambient. More power,
/// less albedo: halving finds it.
float anchoredPower(std::span<const ParameterSample> samples, float ambient)
{
    float low = std::log(kPowers[0]);
    float high = std::log(kPowers[1]);
    for (int i = 0; i < kHalvings; ++i) {
        const float middle = 0.5f * (low + high);
        const bool tooBright = brightestAlbedo(samples, {std::exp(middle), ambient}) > kWhitePaint;
        (tooBright ? low : high) = middle;
    }
    return std::exp(0.5f * (low + high));
}

} // namespace

FittedParameters fitParameters(std::span<const ParameterSample> samples, std::optional<float> power,
                               std::optional<float> ambient)
{
    if (samples.empty()) return {power.value_or(1.0f), ambient.value_or(0.0f)};
    if (power) return {*power, ambient ? *ambient : evenestAmbient(samples, *power)};
    if (ambient) return {anchoredPower(samples, *ambient), *ambient};
    const FittedParameters shape{1.0f, evenestAmbient(samples, 1.0f)};
    const float size = brightestAlbedo(samples, shape) / kWhitePaint;
    return {size, size * shape.ambient};
}

} // namespace relamp
