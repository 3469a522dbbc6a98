#include "solve/albedo_scale.h"

#include "albedo/divide.shared.h"
#include "base/radiometry.shared.h"
#include "shading/tempering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace relamp
{
namespace
{

constexpr float kMuch = 3.0f; // times: the paint of a room's usual surface is that far from white
constexpr double kUnsureLevel = 0.3; // log: of a room's light as a whole
constexpr double kUnsurePlace = 0.3; // log: of the light at one surface
constexpr double kSurfaces = 5.0;    // that err by themselves, in a room

// Numerics.
constexpr double kBin = 0.02;    // log
constexpr double kStep = 0.005;  // log: of the levels that are tried
constexpr size_t kBins = 100;    // up to 7 times as white as paper
constexpr double kHighest = 1.5; // log: of the levels that are tried

/// Shares of all light that fall on surfaces which seem whiter than paper, by how much: a
/// logarithm, kBin a bin.
using TooWhite = std::array<double, kBins>;

TooWhite tooWhite(std::span<const float> albedo, std::span<const float> light)
{
    TooWhite found{};
    const double all = std::accumulate(light.begin(), light.end(), 0.0);
    for (size_t s = 0; s < albedo.size(); ++s) {
        if (light[s] <= 0.0f || albedo[s] <= kWhitestPaper) continue;
        const double log = std::log(static_cast<double>(albedo[s] / kWhitestPaper));
        const auto bin = std::min(static_cast<size_t>(log / kBin), kBins - 1);
        found[bin] += static_cast<double>(light[s]) / all;
    }
    return found;
}

/// Of a room whose light was `log` more than what was found.
double natsOf(const TooWhite& found, double log)
{
    const double level = log / kUnsureLevel;
    double nats = 0.5 * level * level;
    for (size_t b = 0; b < kBins; ++b) {
        const double off = std::max((static_cast<double>(b) + 0.5) * kBin - log, 0.0);
        nats += kSurfaces * found[b] * std::log1p(off * off / (kUnsurePlace * kUnsurePlace));
    }
    return nats;
}

/// In the mean of logarithms over what a person called white.
glm::vec3 scaleToWhite(const FoundRoom& room, std::span<const glm::vec3> light)
{
    glm::vec3 log(0.0f);
    for (const uint32_t s : room.found.white) {
        const glm::vec3 paper = kPi * room.radiance.plain[s] / kWhitestPaper;
        log += glm::log(glm::max(paper, glm::vec3(kFaintest))) -
               glm::log(glm::max(light[s], glm::vec3(kFaintest)));
    }
    return glm::max(glm::exp(log / static_cast<float>(room.found.white.size())),
                    glm::vec3(kFaintest));
}

/// As paint is no whiter than paper.
LackingLight lackOf(const FoundRoom& room, std::span<const glm::vec3> light)
{
    std::vector<float> albedo(light.size());
    std::vector<float> received(light.size(), 0.0f);
    for (size_t s = 0; s < light.size(); ++s) {
        albedo[s] = brightestChannel(kPi * room.radiance.plain[s] /
                                     glm::max(light[s], glm::vec3(kFaintest)));
        if (isHardlyBurntOut(room.radiance, s))
            received[s] = room.radiance.plainArea[s] * luminance(light[s]);
    }
    return lackingLight(albedo, received);
}

/// All lamps are off by what the scale is off by.
void addError(float log, FoundLamps& found)
{
    const auto withIt = [log](glm::vec3 error) { return glm::sqrt(error * error + log * log); };
    for (FoundLamp& lamp : found.lamps) lamp.logError = withIt(lamp.logError);
    if (found.sun) found.sun->sun.error = withIt(found.sun->sun.error);
}

} // namespace

LackingLight lackingLight(std::span<const float> albedo, std::span<const float> light)
{
    const TooWhite found = tooWhite(albedo, light);
    std::vector<double> nats;
    for (double log = 0.0; log <= kHighest; log += kStep) nats.push_back(natsOf(found, log));
    const auto best = std::min_element(nats.begin(), nats.end());
    const double lack = kStep * static_cast<double>(best - nats.begin());
    double sum = 0.0;
    double squares = 0.0;
    for (size_t k = 0; k < nats.size(); ++k) {
        const double likely = std::exp(*best - nats[k]);
        const double off = kStep * static_cast<double>(k) - lack;
        sum += likely;
        squares += likely * off * off;
    }
    return {static_cast<float>(lack), static_cast<float>(std::min(std::sqrt(squares / sum), lack))};
}

void scaleAlbedo(std::span<const glm::vec3> irradiance, FoundRoom& room)
{
    const bool isTold = !room.found.white.empty();
    if (room.isGiven || (isOfScan(room.tempering) && !isTold)) return;
    const std::vector<glm::vec3> light =
        tempered(room.tempering, {irradiance.begin(), irradiance.end()});
    if (isTold) {
        room.tempering.scale = scaleToWhite(room, light);
    } else {
        const LackingLight lack = lackOf(room, light);
        room.tempering.scale = glm::vec3(std::exp(lack.log));
        addError(lack.error, room.found);
    }
    const float times = luminance(room.tempering.scale);
    if (isTold && (times > kMuch || times < 1.0f / kMuch))
        room.warnings.push_back(fmt::format(
            "albedo where something was called white came to {:.2g}, and all of the room was made "
            "{:.2g} times as bright: is it white?",
            kWhitestPaper * times, 1.0f / times));
    if (!isTold && std::log(static_cast<double>(times)) > kUnsureLevel)
        room.warnings.push_back(fmt::format(
            "much of the room came out whiter than paper, so its light was taken for {:.2g} times "
            "what was found: a window or a lamp is missing that is not burnt out. Point at "
            "something white with --white",
            times));
}

} // namespace relamp
