#include "relight/sky_bins.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "relight/sky_bins.shared.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr size_t kSamples = 8; // of a bin, along each side

glm::vec3 directionAt(float around, float up)
{
    const float y = 2.0f * up - 1.0f;
    const float radius = std::sqrt(std::max(1.0f - y * y, 0.0f));
    const float angle = 2.0f * kPi * around;
    return {radius * std::cos(angle), y, radius * std::sin(angle)};
}

} // namespace

size_t SkyBins::of(glm::vec3 direction)
{
    const float around = std::atan2(direction.z, direction.x) / (2.0f * kPi);
    const float up = 0.5f * (direction.y + 1.0f);
    const auto column = static_cast<size_t>((around - std::floor(around)) * kAround);
    const auto row = static_cast<size_t>(std::clamp(up, 0.0f, 1.0f) * kUp);
    return std::min(row, kUp - 1) * kAround + std::min(column, kAround - 1);
}

glm::vec3 SkyBins::middleOf(size_t bin)
{
    return directionAt((static_cast<float>(bin % kAround) + 0.5f) / kAround,
                       (static_cast<float>(bin / kAround) + 0.5f) / kUp);
}

SeenSky::SeenSky(const Sky& sky) : sky_(sky)
{
    if (sky.environment) picture_.emplace(*sky.environment);
}

glm::vec3 SeenSky::operator()(glm::vec3 direction) const
{
    if (!picture_) return sky_.radiance;
    const Image& image = *sky_.environment;
    const glm::vec2 place = placeInSky(direction, sky_.turn);
    const auto width = static_cast<size_t>(image.width);
    const auto height = static_cast<size_t>(image.height);
    const auto column =
        static_cast<size_t>((place.x - std::floor(place.x)) * static_cast<float>(width));
    const auto row = static_cast<size_t>(place.y * static_cast<float>(height));
    return sky_.radiance *
           (*picture_)[std::min(row, height - 1) * width + std::min(column, width - 1)];
}

std::vector<glm::vec3> skyInBins(const Sky& sky)
{
    if (!sky.environment) return std::vector<glm::vec3>(SkyBins::kCount, sky.radiance);
    const SeenSky seen(sky);
    std::vector<glm::vec3> bins(SkyBins::kCount);
    forEach(bins.size(), [&](size_t bin) {
        glm::vec3 sum(0.0f);
        for (size_t j = 0; j < kSamples; ++j)
            for (size_t i = 0; i < kSamples; ++i) {
                const float x = (static_cast<float>(i) + 0.5f) / kSamples;
                const float y = (static_cast<float>(j) + 0.5f) / kSamples;
                sum += seen(
                    directionAt((static_cast<float>(bin % SkyBins::kAround) + x) / SkyBins::kAround,
                                (static_cast<float>(bin / SkyBins::kAround) + y) / SkyBins::kUp));
            }
        bins[bin] = sum / static_cast<float>(kSamples * kSamples);
    });
    return bins;
}

glm::vec3 skyThroughOpening(const std::vector<glm::vec3>& bins, glm::vec3 outwards)
{
    glm::vec3 sum(0.0f);
    float weights = 0.0f;
    for (size_t bin = 0; bin < bins.size(); ++bin) {
        const float weight = outwards == glm::vec3(0.0f)
                                 ? 1.0f
                                 : std::max(glm::dot(outwards, SkyBins::middleOf(bin)), 0.0f);
        sum += weight * bins[bin];
        weights += weight;
    }
    return sum / weights;
}

} // namespace relamp
