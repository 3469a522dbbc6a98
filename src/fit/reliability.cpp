#include "fit/reliability.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relamp
{
namespace
{

// Standard deviations of the light found, as a share of it.
constexpr float kUnsureOfBacks = 2.0f;   // times the share of a view that meets backs
constexpr float kUnsureOfOutside = 0.4f; // times the share of a view that leaves the scan

// Of these, in rooms with ground truth, after the correction.
constexpr float kLeftUnsure = 0.28f;       // of the deviation before it
constexpr float kLeftOfCorrection = 0.72f; // of what was corrected, in log light
constexpr float kRight = 0.15f;            // of log light: an error that people hardly see

// Numerics.
constexpr float kMostVariance = 1e6f; // of what is not known at all; finite beside any other

float squareOf(float value)
{
    return value * value;
}

float medianOf(std::span<const glm::vec3> irradiance)
{
    std::vector<float> values;
    for (const glm::vec3 light : irradiance) values.push_back(luminance(light));
    const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// What part of the rays of a surfel leaves the scan, and what part meets backs.
struct ShareOfView
{
    float outside = 0.0f;
    float backs = 0.0f;
};
ShareOfView viewOf(const HitLists& hits, size_t surfel)
{
    const std::span<const HitTarget> targets = hits.targetsOf(surfel);
    if (targets.empty()) return {};
    ShareOfView view;
    for (const HitTarget target : targets) {
        if (target.isNothing())
            view.outside += 1.0f;
        else if (target.side().isBack())
            view.backs += 1.0f;
    }
    const auto rays = static_cast<float>(targets.size());
    return {view.outside / rays, view.backs / rays};
}

/// That an error is within kRight, of Student's distribution of two degrees of freedom: its tails
/// are as long as those of the errors of light.
float probabilityRight(float variance)
{
    const float t = kRight / std::sqrt(variance);
    return t / std::sqrt(2.0f + t * t);
}

} // namespace

std::vector<LightVariance> varianceOf(const HitLists& hits, const SurfelLighting& light)
{
    std::vector<LightVariance> variance(light.irradiance.size());
    if (variance.empty()) return variance;
    const float usual = medianOf(light.irradiance);
    forEach(variance.size(), [&](size_t s) {
        const float found = std::max(luminance(light.irradiance[s]), kFaintest);
        const float spread = light.spread.empty() ? 0.0f : light.spread[s];
        const ShareOfView view = viewOf(hits, s);
        variance[s] = {squareOf(kUnsureOfOutside * view.outside),
                       squareOf(kUnsureOfBacks * view.backs), squareOf(spread / found),
                       squareOf(kLostLight * usual / found)};
    });
    return variance;
}

double shareBesideLeak(double leak)
{
    return leak > 0.0 ? 1.0 - leak + 1.0 / std::expm1(1.0 / leak) : 1.0;
}

/// With gaps, each cause lets in its deviation, which is wider by as much as lostLight() is.
float shareExpected(const LightVariance& variance, float gaps)
{
    double unsure = 0.0;
    for (const float cause : {variance.backs, variance.edges, variance.dark})
        unsure += std::sqrt(static_cast<double>(std::min(cause, kMostVariance)));
    const auto wider = static_cast<double>(lostLight(gaps) / kLostLight);
    return static_cast<float>(shareBesideLeak(static_cast<double>(gaps) * wider * unsure));
}

std::vector<float> varianceOfResponse(std::span<const glm::vec3> texture,
                                      std::span<const float> area, const SlopeCovariance& slopes)
{
    constexpr size_t n = Response::kKnots;
    if (slopes == SlopeCovariance{}) return {};
    std::vector<std::array<float, n>> bend;
    std::array<double, n> mean{};
    double sum = 0.0;
    for (size_t s = 0; s < texture.size(); ++s) {
        const float brightness = luminance(texture[s]);
        const auto weight = static_cast<double>(area[s] * brightness); // as albedo's one scale has
        bend.push_back(bendAt(brightness));
        for (size_t k = 0; k < n; ++k) mean[k] += weight * static_cast<double>(bend[s][k]);
        sum += weight;
    }
    std::vector<float> variance(texture.size(), 0.0f);
    if (sum <= 0.0) return variance;
    forEach(variance.size(), [&](size_t s) {
        std::array<float, n> off = bend[s];
        for (size_t k = 0; k < n; ++k) off[k] -= static_cast<float>(mean[k] / sum);
        for (size_t i = 0; i < n; ++i)
            for (size_t k = 0; k < n; ++k) variance[s] += off[i] * slopes[i * n + k] * off[k];
    });
    return variance;
}

std::vector<float> varianceLeft(std::span<const LightVariance> variance, std::span<const float> lit)
{
    std::vector<float> left(variance.size());
    forEach(left.size(), [&](size_t s) {
        const float corrected =
            lit.empty() ? 0.0f : squareOf(kLeftOfCorrection * logOfLight(lit[s]));
        left[s] = std::min(kMostVariance, squareOf(kLeftUnsure) * variance[s].total() + corrected);
    });
    return left;
}

std::vector<SurfelTrust> reliabilityOf(std::span<const LightVariance> variance,
                                       std::span<const float> lit, std::span<const float> ofCamera)
{
    const std::vector<float> ofLight = varianceLeft(variance, lit);
    std::vector<SurfelTrust> trust(variance.size());
    forEach(trust.size(), [&](size_t s) {
        const float total = ofLight[s] + (ofCamera.empty() ? 0.0f : ofCamera[s]);
        const float outside = squareOf(kLeftUnsure) * variance[s].outside;
        const float backs = squareOf(kLeftUnsure) * variance[s].backs;
        const float right = std::log(probabilityRight(total));
        trust[s].seen = std::exp(right * outside / total);
        trust[s].front = std::exp(right * backs / total);
        trust[s].edges = std::exp(right * (total - outside - backs) / total);
    });
    return trust;
}

} // namespace relamp
