#include "fit/lamp_search.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "fit/white_balance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace relamp
{
namespace
{

constexpr double kCurvedNats = 1.1; // log odds of a camera with a contrast curve: three in four
constexpr double kTonedNats = -2.2; // likewise of local tone mapping: one in ten

// Numerics.
constexpr int kCameraRounds = 2; // of what is gathered and what the camera made of it

} // namespace

/// Those of what a camera may have done to contrast, near what is known of it.
CameraColumns LampSearch::contrastColumns(bool isCurved, const std::optional<Gain>& around) const
{
    const TexturePlaces places = evidence_.texturePlaces();
    CameraColumns columns = columnsOf(camera_.response, places);
    if (!isCurved) columns = evenSlope(columns);
    return around ? together(columns, columnsOf(camera_.tone, *around, places)) : columns;
}

/// By a camera that did this, with the leaks that are likeliest then.
LightEstimate LampSearch::solveContrast(LightFit& fit, const LightEstimate& start,
                                        CameraColumns& columns, bool isCurved) const
{
    const double open = fit.expectLeaks(start, columns);
    if (!isCurved) columns.expected.front() = flattenedBy(open);
    return fit.solve(emits_, start.log, columns);
}

/// The same for evidence: `nats` are those against such a camera.
LightEstimate LampSearch::fitOfContrast(bool isCurved, const std::optional<Gain>& around) const
{
    CameraColumns columns = contrastColumns(isCurved, around);
    LightEstimate light = estimate_;
    light.camera = columns.known;
    LightFit fit = fitOf(LampEvidence::kPairsFirst);
    for (int round = 0; round < kCameraRounds; ++round)
        light = solveContrast(fit, light, columns, isCurved);
    light.nats += light.occam - (isCurved ? kCurvedNats : 0.0) - (around ? kTonedNats : 0.0);
    if (around && light.camera.back() <= 0.0) light.nats = INFINITY; // no camera deepens it
    return light;
}

/// How likely a response and local tone mapping are beside all pieces that may emit.
void LampSearch::findContrast()
{
    std::array<LightEstimate, 4> fits; // bit 0: curved, bit 1: toned
    std::array<double, 4> nats{};
    std::optional<Gain> around;
    if (isGainSought_) around = evidence_.brightnessAround(camera_.response);
    forEach(nats.size(), [&](size_t k) {
        const bool isCurved = (k & 1u) != 0;
        const bool isToned = (k & 2u) != 0;
        const bool isSought = (isResponseSought_ || !isCurved) && (isGainSought_ || !isToned);
        fits[k].nats = INFINITY;
        if (isSought) fits[k] = fitOfContrast(isCurved, isToned ? around : std::nullopt);
        nats[k] = fits[k].nats;
    });
    const double least = *std::min_element(nats.begin(), nats.end());
    double sum = 0.0;
    for (double& n : nats) {
        n = std::exp(least - n);
        sum += n;
    }
    const auto sought = [](double belief) { return belief > 0.5 ? belief : 0.0; };
    const double likely = (nats[1] + nats[3]) / sum;
    curved_ = sought(likely);
    if (likely > 0.0)
        doubtOfResponse_ = doubtOfResponse(fits[nats[1] > nats[3] ? 1 : 3], likely, curved_);
    toned_ = sought((nats[2] + nats[3]) / sum);
    bend(LampEvidence::kPairsFirst);
}

/// The light that is gathered changes with the contrast, and with it the contrast. What is only
/// likely is undone by as much: the mean over the cameras that it may have been.
void LampSearch::bend(size_t pairs)
{
    for (int round = 0; round < kCameraRounds && isBent(); ++round) {
        std::optional<Gain> around;
        if (toned_ > 0.0) around = evidence_.brightnessAround(camera_.response);
        CameraColumns columns = contrastColumns(curved_ > 0.0, around);
        LightEstimate light = estimate_;
        light.camera = columns.known;
        LightFit fit = fitOf(pairs);
        light = solveContrast(fit, light, columns, curved_ > 0.0);
        if (curved_ > 0.0) {
            camera_.response = responseOf(light.camera, curved_);
            doubtOfResponse_ = doubtOfResponse(light, curved_, curved_);
        }
        if (toned_ > 0.0)
            camera_.tone = localToneOf(evidence_.brightnessAround(camera_.response),
                                       toned_ * light.camera.back());
        seeByCamera(std::move(light.log));
    }
}

/// Of places, by what they show and the colours of lamps so far.
std::vector<glm::vec3> LampSearch::albedo() const
{
    std::vector<glm::vec3> albedo(model_.places());
    const PackedLight packed(model_);
    for (int c = 0; c < 3; ++c) {
        std::vector<double> radiance;
        for (const Piece& piece : pieces_)
            radiance.push_back(static_cast<double>(piece.radiance[c]));
        for (size_t o = 0; o < model_.outsides; ++o)
            radiance.push_back(static_cast<double>(outside_[o][c]));
        std::vector<double> light;
        for (size_t i = 0; i < albedo.size(); ++i)
            light.push_back(static_cast<double>(model_.gathered[i][c]));
        packed.add(radiance, 0, light);
        for (size_t i = 0; i < albedo.size(); ++i)
            albedo[i][c] =
                kPi * model_.shown[i][c] / std::max(static_cast<float>(light[i]), kFaintest);
    }
    return albedo;
}

/// Undoes a drift of exposure that is likelier than not, and returns how likely it is: by an even
/// gain beside the lamps that are known.
double LampSearch::findDrift()
{
    const CameraColumns drift = columnsOf(camera_.gain, evidence_.texturePlaces());
    CameraColumns none;
    none.worth = drift.worth;
    LightFit fit = fitOf(LampEvidence::kPairsFirst);
    fit.expectLeaks(estimate_.log);
    const std::array<const CameraColumns*, 2> columns{&none, &drift};
    std::array<LightEstimate, 2> fits;
    forEach(fits.size(), [&](size_t k) {
        fits[k] = fit.solve(emits_, estimate_.log, *columns[k], kFirstWidth);
    });
    const double drifted =
        likelihoodByEvidence(fits[0].nats + fits[0].occam - fits[1].nats - fits[1].occam);
    camera_.drifted = static_cast<float>(drifted);
    if (camera_.hasDrifted()) undoDrift(std::move(fits[1]));
    return drifted;
}

void LampSearch::undoDrift(LightEstimate found)
{
    camera_.gain = gainOf(std::move(camera_.gain), found.camera);
    seeByCamera(std::move(found.log));
}

/// The drift of exposure and white balance, among lamps that are known. One round is enough where
/// none is likely: what is gathered hardly changes then.
void LampSearch::findGain()
{
    camera_.gain = evenGainOver(evidence_.texturePlaces().position);
    if (camera_.gain.isOne()) return;
    const double drifted = findDrift();
    for (int round = 0; round < (camera_.hasDrifted() ? kCameraRounds : 1); ++round) {
        CameraColumns columns = columnsOf(camera_.gain, evidence_.texturePlaces());
        columns.worth = worthOfGain(drifted);
        LightFit fit = fitOf(LampEvidence::kPairsFirst);
        fit.expectLeaks(estimate_.log);
        undoDrift(fit.solve(emits_, estimate_.log, columns, kFirstWidth));
    }
    const TexturePlaces places = evidence_.texturePlaces();
    camera_.gain = withWhiteBalance(std::move(camera_.gain), places.position, albedo(),
                                    evidence_.pairs(LampEvidence::kPairsFirst), evidence_.told(),
                                    {drifted, LightFit::effectivePairs(model_)});
    seeByCamera(estimate_.log);
}

/// Everything in the radiance that the camera tells, from light that was found with it.
void LampSearch::seeByCamera(std::vector<double> log)
{
    const double brighter = evidence_.linearize(camera_);
    observe();
    for (double& l : log) l += brighter;
    estimate_ = fitOf(LampEvidence::kPairsFirst).solve(emits_, std::move(log), 1.0);
    noise_ = noiseOf(estimate_);
}

} // namespace relamp
