#include "fit/gained.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

constexpr float kFirstShare = 0.01f; // of the light at places, that a lamp brings in the mean
constexpr float kStep = 3.0f;        // from one share to the next
constexpr int kMostSteps = 4;        // beyond, the lamp would be most of the light

/// Luminance of what comes to a place, and of what it sends.
struct Place
{
    float irradiance;
    float logRadiance;
};

std::vector<Place> placesOf(const FitData& data, const Powers& powers)
{
    std::vector<Place> places(data.places());
    for (size_t i = 0; i < places.size(); ++i) {
        float sum = luminance(data.gathered[i]) + luminance(powers.ambient) * data.missed[i];
        for (size_t f = 0; f < data.lamps; ++f)
            sum += luminance(powers.radiance[f]) * data.direct[i * data.lamps + f];
        places[i] = {std::max(sum, 1e-3f), std::log(std::max(luminance(data.radiance[i]), 1e-4f))};
    }
    return places;
}

/// Mean of the pairs' robust losses where a lamp adds `radiance * direct`.
float lossWith(std::span<const Place> places, std::span<const MaterialPair> pairs,
               std::span<const float> direct, float radiance, std::vector<float>& logAlbedo)
{
    for (size_t i = 0; i < places.size(); ++i)
        logAlbedo[i] =
            places[i].logRadiance - std::log(places[i].irradiance + radiance * direct[i]);
    const auto perScale = static_cast<float>(1.0 / PowersOptions{}.lastScale);
    double sum = 0.0;
    for (const MaterialPair pair : pairs) {
        const float r = (logAlbedo[pair.p] - logAlbedo[pair.q]) * perScale;
        sum += static_cast<double>(std::log(1.0f + r * r));
    }
    return static_cast<float>(sum / static_cast<double>(std::max<size_t>(pairs.size(), 1)));
}

/// From a dim lamp to brighter ones, for as long as that helps.
Gain gainOf(std::span<const Place> places, std::span<const MaterialPair> pairs,
            std::span<const float> direct, float lossWithout)
{
    double share = 0.0; // at radiance 1
    for (size_t i = 0; i < places.size(); ++i)
        share += static_cast<double>(direct[i] / places[i].irradiance);
    if (share <= 0.0) return {};
    Gain best;
    std::vector<float> logAlbedo(places.size());
    float radiance = kFirstShare * static_cast<float>(static_cast<double>(places.size()) / share);
    for (int step = 0; step < kMostSteps; ++step, radiance *= kStep) {
        const float gain = lossWithout - lossWith(places, pairs, direct, radiance, logAlbedo);
        if (gain <= best.loss) break;
        best = {gain, radiance};
    }
    return best;
}

} // namespace

std::vector<Gain> gained(const FitData& data, std::span<const MaterialPair> pairs,
                         const Powers& powers, std::span<const std::span<const float>> direct)
{
    const std::vector<Place> places = placesOf(data, powers);
    const std::vector<float> nothing(places.size(), 0.0f);
    std::vector<float> logAlbedo(places.size());
    const float lossWithout = lossWith(places, pairs, nothing, 0.0f, logAlbedo);
    std::vector<Gain> gains(direct.size());
    forEach(direct.size(),
            [&](size_t i) { gains[i] = gainOf(places, pairs, direct[i], lossWithout); });
    return gains;
}

} // namespace relamp
