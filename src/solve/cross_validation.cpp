#include "solve/cross_validation.h"

#include "base/radiometry.shared.h"
#include "fit/lamp_evidence.h"
#include "fit/pairs.h"
#include "scan/held_out.h"
#include "shading/tempering.shared.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kErrsAlike = 0.5f; // m; light is much the same, and wrong, so far around
constexpr size_t kFewestPairs = 100;
constexpr uint32_t kFewestCubes = 8;
constexpr double kBright = 0.9;       // of places lie below it
constexpr int kPowerSteps = 10;       // of the power from 1 to 0
constexpr double kOnePaint = 0.2;     // stops, beyond which a pair is likelier of two paints
constexpr double kClearly = 2.0;      // standard errors
constexpr float kDarkestTold = 1e-5f; // radiance and shading

bool tells(const Witnesses& witnesses)
{
    return witnesses.pairs.size() >= kFewestPairs && witnesses.cubes >= kFewestCubes;
}

/// At the witnesses, where no fit looks.
std::vector<glm::vec3> shadingOf(const Witnesses& witnesses, std::span<const glm::vec3> irradiance)
{
    std::vector<glm::vec3> shading;
    for (size_t i = 0; i < witnesses.surfels.size(); ++i)
        shading.push_back(
            glm::max(irradiance[witnesses.surfels[i]] * (std::exp(-witnesses.unseen[i]) / kPi),
                     glm::vec3(kDarkestTold)));
    return shading;
}

/// What the best lit places have: then no albedo gets much brighter, and what is whiter than paper
/// would be cut off.
glm::vec3 brightOf(std::span<const glm::vec3> shading)
{
    glm::vec3 bright;
    for (int c = 0; c < 3; ++c) {
        std::vector<float> values;
        for (const glm::vec3 s : shading) values.push_back(s[c]);
        const auto at =
            values.begin() + static_cast<ptrdiff_t>(kBright * static_cast<double>(values.size()));
        std::nth_element(values.begin(), at, values.end());
        bright[c] = *at;
    }
    return bright;
}

std::vector<glm::vec3> albedoUnder(const Witnesses& witnesses, std::span<const glm::vec3> shading,
                                   const Tempering& tempering)
{
    if (isOfScan(tempering)) return witnesses.texture;
    std::vector<glm::vec3> albedo;
    const glm::vec3 factor = factorOf(tempering);
    for (size_t i = 0; i < shading.size(); ++i)
        albedo.push_back(witnesses.radiance[i] /
                         (shading[i] * temperedBy(shading[i], factor, tempering.power)));
    return albedo;
}

/// Of every channel, log2.
std::vector<glm::vec3> stopsOf(std::span<const glm::vec3> colors)
{
    std::vector<glm::vec3> stops;
    for (const glm::vec3 c : colors) stops.push_back(glm::log2(glm::max(c, kDarkestTold)));
    return stops;
}

/// Of pairs: root mean square over the channels.
std::vector<float> differencesOf(const Witnesses& witnesses, std::span<const glm::vec3> stops)
{
    std::vector<float> differences;
    for (const auto& [p, q] : witnesses.pairs)
        differences.push_back(glm::distance(stops[p], stops[q]) / std::sqrt(3.0f));
    return differences;
}

/// Likewise.
std::vector<double> disagreements(const Witnesses& witnesses, std::span<const glm::vec3> colors)
{
    std::vector<double> disagreements;
    for (const float stops : differencesOf(witnesses, stopsOf(colors))) {
        const double off = static_cast<double>(stops) / kOnePaint;
        disagreements.push_back(std::log1p(off * off));
    }
    return disagreements;
}

/// By how much `other` is better than `all`, a pair in the mean, and the standard error of that:
/// of pairs that have a place in the same cube, as of dyads (Aronow, Samii and Assenova 2015).
struct Improvement
{
    double mean = 0.0;
    double error = 0.0;

    [[nodiscard]] bool isClear() const { return mean > kClearly * error; }
};
Improvement improvementOf(const Witnesses& witnesses, std::span<const double> all,
                          std::span<const double> other)
{
    Improvement by;
    const auto count = static_cast<double>(all.size());
    for (size_t k = 0; k < all.size(); ++k) by.mean += (all[k] - other[k]) / count;
    std::vector<double> ofCube(witnesses.cubes, 0.0);
    for (size_t k = 0; k < all.size(); ++k) {
        const auto [p, q] = witnesses.pairs[k];
        const double off = all[k] - other[k] - by.mean;
        ofCube[witnesses.cube[p]] += off;
        if (witnesses.cube[p] != witnesses.cube[q]) ofCube[witnesses.cube[q]] += off;
    }
    for (const double sum : ofCube) by.error += sum * sum;
    by.error = std::sqrt(by.error) / count;
    return by;
}

float lowerQuartile(std::vector<float> values)
{
    const auto at = values.begin() + static_cast<ptrdiff_t>(values.size() / 4);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

float unevennessOf(const Witnesses& witnesses, std::span<const glm::vec3> colors)
{
    return lowerQuartile(differencesOf(witnesses, stopsOf(colors)));
}

/// The same of what is left without brightness.
float unevennessOfChroma(const Witnesses& witnesses, std::span<const glm::vec3> colors)
{
    std::vector<glm::vec3> stops = stopsOf(colors);
    for (glm::vec3& s : stops) s -= (s.r + s.g + s.b) / 3.0f;
    return lowerQuartile(differencesOf(witnesses, stops));
}

} // namespace

Witnesses witnessesOf(const Surfels& surfels, const RayScene& scene,
                      std::span<const glm::vec3> texture, const SurfelRadiance& radiance,
                      std::span<const float> changeUnseen, Quality quality, double rooms)
{
    Witnesses found{.surfels = placesToLookAt(surfels, radiance, quality, rooms)};
    found.unseen.assign(changeUnseen.begin(), changeUnseen.end());
    found.unseen.resize(found.surfels.size(), 0.0f);
    std::vector<int> fold;
    std::map<std::array<int, 3>, uint32_t> cubes;
    for (const uint32_t s : found.surfels) {
        found.texture.push_back(texture[s]);
        found.radiance.push_back(radiance.plain[s]);
        fold.push_back(foldOf(surfels.position[s], surfels.seed));
        const glm::ivec3 cube = cubeOf(surfels.position[s], kErrsAlike, surfels.seed);
        found.cube.push_back(
            cubes.try_emplace({cube.x, cube.y, cube.z}, found.cubes).first->second);
        found.cubes = static_cast<uint32_t>(cubes.size());
    }
    found.pairs = drawPairs(found.texture, found.surfels, surfels, scene, LampEvidence::kPairs);
    const auto place = [&](uint32_t i) { return surfels.position[found.surfels[i]]; };
    std::erase_if(found.pairs, [&](MaterialPair pair) {
        return fold[pair.p] != fold[pair.q] ||
               glm::distance(place(pair.p), place(pair.q)) < kErrsAlike;
    });
    return found;
}

Tempering temperingFor(const Witnesses& witnesses, std::span<const glm::vec3> irradiance)
{
    if (!tells(witnesses)) return {};
    const std::vector<glm::vec3> shading = shadingOf(witnesses, irradiance);
    const glm::vec3 kept = brightOf(shading);
    const auto under = [&](const Tempering& tempering) {
        return disagreements(witnesses, albedoUnder(witnesses, shading, tempering));
    };
    const std::vector<double> all = under({});
    Tempering best;
    double most = 0.0;
    for (int step = kPowerSteps - 1; step >= 0; --step) {
        const Tempering tempering =
            step == 0 ? Tempering{.power = 0.0f}
                      : Tempering{kept, static_cast<float>(step) / static_cast<float>(kPowerSteps)};
        const Improvement by = improvementOf(witnesses, all, under(tempering));
        if (by.mean <= most || !by.isClear()) continue;
        most = by.mean;
        best = tempering;
    }
    return best;
}

CrossValidation crossValidate(const Witnesses& witnesses, std::span<const glm::vec3> irradiance,
                              const Tempering& tempering)
{
    if (!tells(witnesses)) return {};
    const std::vector<glm::vec3> albedo =
        albedoUnder(witnesses, shadingOf(witnesses, irradiance), tempering);
    const Improvement byScan = improvementOf(witnesses, disagreements(witnesses, albedo),
                                             disagreements(witnesses, witnesses.texture));
    return {.pairs = witnesses.pairs.size(),
            .scan = unevennessOf(witnesses, witnesses.texture),
            .albedo = unevennessOf(witnesses, albedo),
            .chromaOfScan = unevennessOfChroma(witnesses, witnesses.texture),
            .chromaOfAlbedo = unevennessOfChroma(witnesses, albedo),
            .shadingPower = tempering.power,
            .improves = !isOfScan(tempering) && !byScan.isClear()};
}

std::vector<std::string> warningsOf(const CrossValidation& validation)
{
    constexpr const char* kWayOut =
        "Look at the lights in lights.json: point at lamps that are not there with --light, at "
        "what is none with --not-a-light, correct lights.json and pass it with --lights, or leave "
        "the sun out with --no-sun";
    if (validation.shadingPower == 0.0f)
        return {fmt::format("places of one paint agree better in the scan than in the albedo, so "
                            "the scan itself was taken for it. {}",
                            kWayOut)};
    if (validation.shadingPower < 1.0f)
        return {fmt::format(
            "the light that was found is stronger than what the scan shows of it: places of one "
            "paint agree better under its shading to the power of {:.1f}, which was taken "
            "instead, and confidence is lowered everywhere. {}",
            validation.shadingPower, kWayOut)};
    if (!validation.improves)
        return {fmt::format(
            "the albedo is no better than the scan: places of one paint agree less in it, so that "
            "its shading is not to be believed, and confidence is lowered everywhere. {}",
            kWayOut)};
    return {};
}

} // namespace relamp
