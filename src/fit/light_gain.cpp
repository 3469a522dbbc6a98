#include "fit/light_gain.h"

#include "fit/light_fit_search.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

// Numerics.
constexpr int kTried = 6;     // radiances,
constexpr double kStep = 3.0; // each so many times the last

} // namespace

LightGain::LightGain(const LightFit& fit, const LightEstimate& estimate,
                     const CameraColumns& camera)
    : fit_(fit), radiance_(exponentials(estimate.log)),
      light_(fit.irradiance(radiance_, 0, fit.model_.places())),
      logAlbedo_(fit.logAlbedo(estimate, camera)), logShown_(logAlbedo_), lit_(fit.model_.pieces)
{
    for (size_t i = 0; i < light_.size(); ++i) logShown_[i] += std::log(light_[i]);
    for (uint32_t i = 0; i < light_.size(); ++i)
        for (const auto [f, direct] : fit.model_.direct[i])
            if (direct > 0.0f) lit_[f].push_back({i, direct});
}

/// Brings 1 % of the light at places; 0 where it brings none that others don't.
double LightGain::firstTried(size_t piece) const
{
    double share = 0.0;
    for (const auto [i, direct] : lit_[piece])
        share += static_cast<double>(direct) /
                 (light_[i] - radiance_[piece] * static_cast<double>(direct));
    return share > 0.0 ? 0.01 * static_cast<double>(light_.size()) / share : 0.0;
}

double LightGain::leastOf(size_t piece) const
{
    return std::log(std::max(firstTried(piece), kStep * radiance_[piece]));
}

/// Only the places that it lights change, and the pairs that they are in.
double LightGain::of(size_t piece, double& best) const
{
    double r = firstTried(piece);
    if (r <= 0.0) return 0.0;
    const double was = radiance_[piece];
    std::vector<uint8_t> isLit(light_.size(), 0);
    for (const LitPlace place : lit_[piece]) isLit[place.place] = 1;
    std::vector<size_t> changed;
    for (size_t k = 0; k < fit_.pairs_.size(); ++k)
        if ((isLit[fit_.pairs_[k].p] | isLit[fit_.pairs_[k].q]) != 0) changed.push_back(k);
    std::vector<double> logAlbedo = logAlbedo_;
    const auto residual = [&](MaterialPair pair) { return logAlbedo[pair.p] - logAlbedo[pair.q]; };
    const auto nats = [&](double radiance) {
        for (const auto [i, direct] : lit_[piece])
            logAlbedo[i] =
                logShown_[i] - std::log(light_[i] + (radiance - was) * static_cast<double>(direct));
        SumOfLogs sum;
        for (const size_t k : changed) {
            const double off = residual(fit_.pairs_[k]);
            const double times = off / fit_.noiseOf(k, off);
            sum.add(times * times);
        }
        double told = 0.0;
        for (const MaterialPair pair : fit_.told_) told += natsOfTold(residual(pair));
        return fit_.perPair() * sum.value() + told;
    };
    const double without = nats(was);
    double most = 0.0;
    for (int tried = 0; tried < kTried; ++tried, r *= kStep) {
        if (r < was) continue;
        const double gained = without - nats(r);
        if (gained > most) {
            most = gained;
            best = std::log(r);
        }
    }
    const size_t own = fit_.model_.placeOf(piece);
    return most + fit_.boundCost(piece, std::log(fit_.irradiance(radiance_, own, own + 1).front()));
}

} // namespace relamp
