#include "fit/light_fit.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "fit/camera_columns.h"
#include "fit/light_fit_search.h"
#include "fit/reliability.h"
#include "lights/candidates.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relamp
{
namespace
{

// That all pairs of a room are worth: what is wrong with the light at a place is wrong at all
// places near it. Of the lamps of rooms with ground truth 81 % are then within one standard error
// and 97 % within two; with 100 or more, reconstructed rooms lose and small false lamps come in.
constexpr double kPairsOfRoom = 75.0;
constexpr double kOutside = 0.3;        // of the median radiance: what scanners miss lies in shade
constexpr double kBurntOutPaper = 0.75; // albedo of what burns out first

// Numerics.
constexpr double kLeastIrradiance = 1e-3; // radiance sr, that no place falls below

} // namespace

LightFit::LightFit(const LightModel& model, std::span<const MaterialPair> pairs,
                   std::span<const AlikePieces> alike, double noise, int channel)
    : model_(model), light_(model), pairs_(pairs), alike_(alike), channel_(channel), noise_(noise),
      noiseAbove_(pairs.size(), noise), noiseBelow_(pairs.size(), noise),
      paintShare_(pairs.size(), 1.0),
      normalization_(static_cast<double>(pairs.size()) * std::log(noise))
{
    for (size_t i = 0; i < model.shown.size(); ++i) {
        logShown_.push_back(
            std::log(std::max(pick(model.shown[i]), static_cast<double>(kFaintest))));
        gathered_.push_back(pick(model.gathered[i]));
    }
    whiteShare_.assign(model.pieces, 0.0);
    for (size_t i = 0; i < model.places(); ++i) {
        const double light =
            std::max(static_cast<double>(kPi) * std::exp(logShown_[i]), kLeastIrradiance);
        const double share = 1.0 / (light * static_cast<double>(model.places()));
        for (const auto [f, direct] : model.direct[i])
            whiteShare_[f] += share * static_cast<double>(direct);
    }
    const auto end = logShown_.begin() + static_cast<ptrdiff_t>(model.places());
    outside_ = medianOfAll({logShown_.begin(), end}) + std::log(kOutside);
}

double LightFit::pick(glm::vec3 rgb) const
{
    return static_cast<double>(channel_ < 0 ? luminance(rgb) : rgb[channel_]);
}

double LightFit::perPair() const
{
    return effectivePairs(model_) / static_cast<double>(std::max<size_t>(pairs_.size(), 1));
}

std::vector<double> LightFit::irradiance(std::span<const double> radiance, size_t first,
                                         size_t end) const
{
    std::vector<double> light;
    for (size_t i = first; i < end; ++i) light.push_back(gathered_[i] + kLeastIrradiance);
    light_.add(radiance, first, light);
    return light;
}

/// How much too dark a piece is that only reflects, even as the brightest paper, >= 0.
double LightFit::lack(size_t piece, double logIrradiance) const
{
    if (model_.area[piece] <= 0.0f) return 0.0;
    const double least =
        logShown_[model_.placeOf(piece)] + std::log(static_cast<double>(kPi / kWhitestPaper));
    return std::max(least - logIrradiance, 0.0);
}

/// The chance that a piece which only reflects is burnt out without the light for it.
double LightFit::flaw(size_t piece) const
{
    if (!model_.fades.empty() && model_.fades[piece] != 0) return kFlawOfSpeck;
    const float size = std::max(model_.area[piece], kSpeck);
    return kFlawOfSpeck * static_cast<double>(kSpeck / size);
}

double LightFit::boundCost(size_t piece, double logIrradiance) const
{
    const double off = lack(piece, logIrradiance) / kBoundNoise;
    if (off <= 0.0) return 0.0;
    const double flaw = this->flaw(piece);
    return -std::log((1.0 - flaw) * std::exp(-0.5 * off * off) + flaw);
}

double LightFit::expectLeaks(std::span<const double> log)
{
    return expectLeaks({.log = {log.begin(), log.end()}}, {});
}

double LightFit::expectLeaks(const LightEstimate& estimate, const CameraColumns& camera)
{
    const std::vector<double> radiance = exponentials(estimate.log);
    const std::vector<double> logAlbedo = this->logAlbedo(estimate, camera);
    const std::vector<double> light = irradiance(radiance, 0, model_.places());
    const double usual = medianOfAll(light);
    const auto leakOfModel = static_cast<double>(lostLight(0.0f));
    const auto leakOfScan = static_cast<double>(lostLight(1.0f));
    const double ofModel = costOfLeak(leakOfModel * usual, light, logAlbedo);
    for (size_t k = 0; k < pairs_.size(); ++k)
        paintShare_[k] = 2.0 * noise_ * noise_ /
                         (noiseAbove_[k] * noiseAbove_[k] + noiseBelow_[k] * noiseBelow_[k]);
    const double ofScan = costOfLeak(leakOfScan * usual, light, logAlbedo);
    const double open = 1.0 / (1.0 + std::exp(perPair() * (ofScan - ofModel)));
    auto leak = static_cast<double>(lostLight(static_cast<float>(open)));
    // A contrast curve, too, makes the dark too dark: where leaks are expected that are not there,
    // it is hardly heard. (Lamps are told with leaks whatever the pairs say of none.)
    if (camera.count() > 0) {
        const double ofNone = costOfLeak(0.0, light, logAlbedo);
        leak /= 1.0 + std::exp(perPair() * (std::min(ofModel, ofScan) - ofNone) - kHardlyEverNats);
    }
    costOfLeak(leak * usual, light, logAlbedo);
    return open;
}

double LightFit::gaps(std::span<const double> log)
{
    const LightEstimate estimate{.log = {log.begin(), log.end()}};
    std::vector<double> logAlbedo = this->logAlbedo(estimate, {});
    const std::vector<double> light = irradiance(exponentials(log), 0, model_.places());
    const double lost = static_cast<double>(lostLight(0.0f)) * medianOfAll(light);
    const double ofWhole = costOfLeak(lost, light, logAlbedo);
    for (size_t i = 0; i < light.size(); ++i)
        logAlbedo[i] -= std::log(shareBesideLeak(lost / light[i]));
    const double ofOpen =
        costOfLeak(static_cast<double>(lostLight(1.0f) / lostLight(0.0f)) * lost, light, logAlbedo);
    return 1.0 / (1.0 + std::exp(perPair() * (ofOpen - ofWhole)));
}

/// Takes noise for what such a leak makes it, and returns what the pairs cost then.
double LightFit::costOfLeak(double leak, std::span<const double> light,
                            std::span<const double> logAlbedo)
{
    SumOfLogs cost;
    normalization_ = 0.0;
    for (size_t k = 0; k < pairs_.size(); ++k) {
        const auto [p, q] = pairs_[k];
        noiseAbove_[k] = std::hypot(noise_, leak / light[q]); // q seems too dark
        noiseBelow_[k] = std::hypot(noise_, leak / light[p]);
        const double residual = logAlbedo[p] - logAlbedo[q];
        const double off = residual / noiseOf(k, residual);
        normalization_ += std::log(0.5 * (noiseAbove_[k] + noiseBelow_[k]));
        cost.add(off * off);
    }
    return cost.value() + normalization_;
}

std::vector<double> LightFit::reflected(std::span<const double> log) const
{
    std::vector<double> sent = irradiance(exponentials(log), model_.places(), model_.shown.size());
    for (size_t f = 0; f < sent.size(); ++f)
        sent[f] = model_.area[f] <= 0.0f
                      ? std::log(static_cast<double>(kFaintest))
                      : std::max(std::log(kBurntOutPaper / static_cast<double>(kPi) * sent[f]),
                                 logShown_[model_.placeOf(f)]);
    return sent;
}

double LightFit::costOfPairs(size_t first, std::span<const double> log) const
{
    const std::vector<double> light = irradiance(exponentials(log), 0, model_.places());
    SumOfLogs sum;
    for (size_t k = first; k < pairs_.size(); ++k) {
        const auto [p, q] = pairs_[k];
        const double residual = logShown_[p] - logShown_[q] + std::log(light[q] / light[p]);
        const double off = residual / noiseOf(k, residual);
        sum.add(off * off);
    }
    return perPair() * sum.value();
}

std::vector<double> LightEstimate::start() const
{
    std::vector<double> start = log;
    start.insert(start.end(), camera.begin(), camera.end());
    return start;
}

std::vector<double> LightFit::logAlbedo(const LightEstimate& estimate,
                                        const CameraColumns& camera) const
{
    std::vector<double> logAlbedo = irradiance(exponentials(estimate.log), 0, model_.places());
    for (size_t i = 0; i < logAlbedo.size(); ++i) {
        logAlbedo[i] = logShown_[i] - std::log(logAlbedo[i]);
        for (size_t k = 0; k < camera.count(); ++k)
            logAlbedo[i] +=
                (estimate.camera[k] - camera.known[k]) * static_cast<double>(camera.bendAt(i)[k]);
    }
    return logAlbedo;
}

double LightFit::effectivePairs(const LightModel& model)
{
    return model.rooms * kPairsOfRoom;
}

LightEstimate LightFit::solve(std::span<const uint8_t> emits, std::vector<double> start,
                              double widest, const EmissionPrior& prior) const
{
    const CameraColumns none;
    LightFitSearch search(*this, emits, prior, std::move(start), none);
    search.run(widest);
    return search.result();
}

LightEstimate LightFit::trial(std::span<const uint8_t> emits, std::vector<double> start,
                              double most, const CameraColumns& camera) const
{
    const EmissionPrior prior;
    LightFitSearch search(*this, emits, prior, std::move(start), camera);
    search.run(1.0, most);
    return search.estimate();
}

LightEstimate LightFit::solve(std::span<const uint8_t> emits, std::vector<double> start,
                              const CameraColumns& camera, double widest) const
{
    const EmissionPrior prior;
    LightFitSearch search(*this, emits, prior, std::move(start), camera);
    search.run(widest);
    return search.result();
}

std::vector<uint8_t> LightFit::needless(const LightEstimate& estimate,
                                        std::span<const uint8_t> emits,
                                        std::span<const Removal> removals,
                                        const CameraColumns& camera) const
{
    const EmissionPrior prior;
    LightFitSearch search(*this, emits, prior, estimate.start(), camera);
    search.run(1.0);
    return search.needless(removals);
}

} // namespace relamp
