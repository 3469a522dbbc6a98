#include "solve/albedo_scale.h"

#include "albedo/divide.shared.h"
#include "base/radiometry.shared.h"
#include "shading/tempering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace relamp
{
namespace
{

constexpr float kMuch = 3.0f; // times: the paint of a room's usual surface is that far from white
// Of what light falls on, brightest channel: ceilings have 0.8, walls 0.5, floors 0.2.
constexpr double kUsual = 0.5;
constexpr double kRoomsDiffer = 0.3;   // log: in that; 0.2 in eleven rooms with truth
constexpr double kAllOverPlaces = 3.5; // times: all light is off by, beside places of one paint
constexpr double kNothingTells = 0.05; // log: taken for these where too few pairs tell
constexpr double kSurfaces = 5.0;      // that err by themselves, in a room
constexpr double kClearlyOff = 0.3;    // log: worth a warning

// Numerics.
constexpr double kBin = 0.02;         // log
constexpr double kStep = 0.005;       // log: of the levels that are tried
constexpr size_t kBins = 150;         // from kLowest to 2; what is whiter counts as 2
constexpr double kLowest = -1.0;      // log: of these levels
constexpr double kHighest = 1.5;      // log
constexpr double kLeastProven = 0.01; // log
constexpr float kDarkestPaint = 0.01f;

/// Shares of all light.
struct Paint
{
    std::array<double, kBins> white{}; // by log(albedo / kWhitePaint), kBin a bin from kLowest on
    double mean = 0.0;                 // log(albedo / kUsual)
};

Paint paintOf(std::span<const float> albedo, std::span<const float> light)
{
    Paint paint;
    const double all = std::accumulate(light.begin(), light.end(), 0.0);
    for (size_t s = 0; s < albedo.size(); ++s) {
        if (light[s] <= 0.0f) continue;
        const double share = static_cast<double>(light[s]) / all;
        const double log = std::log(static_cast<double>(std::max(kDarkestPaint, albedo[s])));
        const double white = log - std::log(static_cast<double>(kWhitePaint));
        paint.mean += share * (log - std::max(white, 0.0) - std::log(kUsual)); // or it shines
        const double bin = std::min((white - kLowest) / kBin, static_cast<double>(kBins - 1));
        if (bin >= 0.0) paint.white[static_cast<size_t>(bin)] += share;
    }
    return paint;
}

/// Of a room whose light was `log` more than what was found, where places err by `error`.
double natsOf(const Paint& paint, double log, double error)
{
    const double level = log / (kAllOverPlaces * error);
    const double usual = (paint.mean - log) / kRoomsDiffer;
    double nats = 0.5 * (level * level + usual * usual);
    for (size_t b = 0; b < kBins; ++b) {
        const double white = kLowest + (static_cast<double>(b) + 0.5) * kBin;
        const double off = std::max(white - log, 0.0) / error;
        nats += kSurfaces * paint.white[b] * std::log1p(off * off);
    }
    return nats;
}

/// In the mean of logarithms over what a person called white.
glm::vec3 scaleToWhite(const FoundRoom& room, std::span<const glm::vec3> light)
{
    glm::vec3 log(0.0f);
    for (const uint32_t s : room.found.white) {
        const glm::vec3 paper = kPi * room.radiance.plain[s] / kWhitePaint;
        log += glm::log(glm::max(paper, glm::vec3(kFaintest))) -
               glm::log(glm::max(light[s], glm::vec3(kFaintest)));
    }
    return glm::max(glm::exp(log / static_cast<float>(room.found.white.size())),
                    glm::vec3(kFaintest));
}

/// As rooms are painted.
LackingLight lackOf(const FoundRoom& room, std::span<const glm::vec3> light,
                    const CrossValidation& proof)
{
    std::vector<float> albedo(light.size());
    std::vector<float> received(light.size(), 0.0f);
    for (size_t s = 0; s < light.size(); ++s) {
        albedo[s] = brightestChannel(kPi * room.radiance.plain[s] /
                                     glm::max(light[s], glm::vec3(kFaintest)));
        if (isHardlyBurntOut(room.radiance, s))
            received[s] = room.radiance.plainArea[s] * luminance(light[s]);
    }
    const double differ = proof.pairs == 0 ? kNothingTells : std::numbers::ln2 * proof.albedo;
    return lackingLight(albedo, received, static_cast<float>(differ));
}

/// Of light that was taken for `times` what was found.
void warnOf(float times, bool isTold, std::vector<std::string>& warnings)
{
    const double log = std::log(static_cast<double>(times));
    if (isTold && (times > kMuch || times < 1.0f / kMuch))
        warnings.push_back(fmt::format(
            "albedo where something was called white came to {:.2g}, and all of the room was made "
            "{:.2g} times as bright: is it white?",
            kWhitePaint * times, 1.0f / times));
    if (!isTold && log > kClearlyOff)
        warnings.push_back(fmt::format(
            "the room came out brighter than rooms are painted, so its light was taken for {:.2g} "
            "times what was found: a window or a lamp may be missing that is not burnt out. Point "
            "at it with --light, or at something white with --white",
            times));
    if (!isTold && log < -kClearlyOff)
        warnings.push_back(fmt::format(
            "the room came out darker than rooms are painted, so its light was taken for {:.2g} "
            "times what was found: something in lights.json may be no lamp, or too strong. Point "
            "at something white with --white",
            times));
}

/// All lamps are off by what the scale is off by.
void addError(float log, FoundLamps& found)
{
    const auto withIt = [log](glm::vec3 error) { return glm::sqrt(error * error + log * log); };
    for (FoundLamp& lamp : found.lamps) lamp.logError = withIt(lamp.logError);
    if (found.sun) found.sun->sun.error = withIt(found.sun->sun.error);
}

} // namespace

LackingLight lackingLight(std::span<const float> albedo, std::span<const float> light,
                          float placesDiffer)
{
    if (std::ranges::none_of(light, [](float l) { return l > 0.0f; })) return {};
    const Paint paint = paintOf(albedo, light);
    if (!std::isfinite(paint.mean)) return {}; // a surfel's light is no number, so this is none
    const double error = std::max(kLeastProven, static_cast<double>(placesDiffer));
    std::vector<double> nats;
    for (double log = kLowest; log <= kHighest; log += kStep)
        nats.push_back(natsOf(paint, log, error));
    const auto best = std::min_element(nats.begin(), nats.end());
    const auto at = static_cast<double>(best - nats.begin());
    double sum = 0.0;
    double squares = 0.0;
    for (size_t k = 0; k < nats.size(); ++k) {
        const double likely = std::exp(*best - nats[k]);
        const double off = kStep * (static_cast<double>(k) - at);
        sum += likely;
        squares += likely * off * off;
    }
    const double lack = kLowest + kStep * at;
    return {static_cast<float>(lack),
            static_cast<float>(std::min(std::sqrt(squares / sum), std::abs(lack)))};
}

void scaleAlbedo(std::span<const glm::vec3> irradiance, const CrossValidation& proof,
                 FoundRoom& room)
{
    const bool isTold = !room.found.white.empty();
    if (room.isGiven || (isOfScan(room.tempering) && !isTold)) return;
    const std::vector<glm::vec3> light =
        tempered(room.tempering, {irradiance.begin(), irradiance.end()});
    if (isTold) {
        room.tempering.scale = scaleToWhite(room, light);
    } else {
        const LackingLight lack = lackOf(room, light, proof);
        room.tempering.scale = glm::vec3(std::exp(lack.log));
        addError(lack.error, room.found);
    }
    warnOf(luminance(room.tempering.scale), isTold, room.warnings);
}

} // namespace relamp
