#include "fit/sun_search.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "fit/light_gain.h"
#include "fit/sun.h"
#include "fit/sun_directions.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relamp
{
namespace
{

/// Albedo that surfels would have in the light that is known. Lamps send what they were fitted
/// with, other burnt-out surfaces at least what they show.
std::vector<float> apparentAlbedo(const SurfelRadiance& radiance, const LightSoFar& light)
{
    std::vector<float> sent;
    for (const glm::vec3 shown : shownOf(radiance)) sent.push_back(luminance(shown));
    for (size_t f = 0; f < light.pieces.size(); ++f)
        for (const ClippedPatch& patch : light.pieces[f].candidate.patches)
            if (light.emits[f] != 0 && patch.surfel != Surfels::kNone)
                sent[patch.surfel] =
                    std::max(sent[patch.surfel], static_cast<float>(std::exp(light.log[f])));
    for (size_t s = 0; s < sent.size(); ++s) {
        const glm::vec3 irradiance = light.sides.direct[s] + light.sides.gathered.irradiance[s];
        sent[s] *= kPi / std::max(luminance(irradiance), 1e-6f);
    }
    return sent;
}

/// The room with a sun against the room without one, all else as likely as it can be. Soft light
/// from outside does much the same on the whole: the rim alone must tell, and all the rest not
/// speak against it. `tries`: nats that it must gain; none where it does not.
std::optional<SunFit> fitOf(SunTrial trial, const LightSoFar& light, double tries)
{
    std::vector<MaterialPair> pairs(light.pairs.begin(), light.pairs.end());
    const std::vector<MaterialPair> across = trial.pairs(pairs.size());
    pairs.insert(pairs.end(), across.begin(), across.end());
    std::vector<uint8_t> emits(light.emits.begin(), light.emits.end());
    emits.push_back(0);
    std::vector<double> start(light.log.begin(), light.log.end());
    start.insert(start.end() - static_cast<ptrdiff_t>(light.model.outsides), 0.0);
    LightFit sunny(trial.with, pairs, light.alike, light.noise);
    sunny.believe(light.told);
    const size_t sun = trial.sun();
    double log = 0.0;
    if (LightGain(sunny, {.log = start}).of(sun, log) < tries)
        return std::nullopt; // saves two fits

    LightFit shade(trial.without, pairs, light.alike, light.noise);
    shade.believe(light.told);
    const LightEstimate without = shade.solve(emits, start, 1.0);
    double saved = 0.0;
    for (const SunPatch& patch : trial.patches) {
        if (emits[patch.piece] != 0) saved += light.cost[patch.piece];
        emits[patch.piece] = 0;
    }
    emits[sun] = 1;
    start = without.log;
    start[sun] = log;
    LightEstimate with = sunny.solve(emits, start, 1.0);

    const double onTheWhole = without.nats - with.nats + saved;
    const double byRim = shade.costOfPairs(light.pairs.size(), without.log) -
                         sunny.costOfPairs(light.pairs.size(), with.log);
    const double evidence = std::min(onTheWhole, byRim) - tries;
    if (evidence <= 0.0) return std::nullopt;
    return SunFit{std::move(trial), std::move(emits), std::move(with), evidence};
}

} // namespace

std::optional<SunFit> findSun(const Texels& texels, const RayScene& outside, const HitLists& hits,
                              const SurfelRadiance& radiance, const LightSoFar& light)
{
    const SunDirections directions =
        sunDirections(texels, outside, radiance, apparentAlbedo(radiance, light));
    const double tries =
        light.costOfSun + std::log(static_cast<double>(std::max<size_t>(directions.tried, 1)));
    std::vector<std::optional<SunFit>> fits(directions.towards.size());
    forEach(fits.size(), [&](size_t k) {
        const glm::vec3 towards = directions.towards[k];
        const AreaLight disc(sunDisc({.direction = towards}, *texels.scan));
        fits[k] =
            fitOf({texels, radiance, light, towards, directOfLists(texels, outside, hits, {disc})},
                  light, tries);
    });
    std::optional<SunFit> best;
    for (std::optional<SunFit>& fit : fits)
        if (fit && (!best || fit->evidence > best->evidence)) best = std::move(fit);
    return best;
}

} // namespace relamp
