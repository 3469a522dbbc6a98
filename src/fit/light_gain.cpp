#include "fit/light_gain.h"

#include "fit/light_fit_search.h"

#include <cmath>

namespace relamp
{

LightGain::LightGain(const LightFit& fit, const LightEstimate& estimate)
    : fit_(fit), radiance_(exponentials(estimate.log)),
      light_(fit.irradiance(radiance_, 0, fit.model_.places())), logAlbedo_(light_.size()),
      lit_(fit.model_.pieces)
{
    for (size_t i = 0; i < light_.size(); ++i)
        logAlbedo_[i] = fit.logShown_[i] - std::log(light_[i]);
    for (uint32_t i = 0; i < light_.size(); ++i)
        for (const auto [f, direct] : fit.model_.direct[i])
            if (direct > 0.0f) lit_[f].push_back({i, direct});
}

/// Only the places that it lights change, and the pairs that they are in.
double LightGain::of(size_t piece, double& best) const
{
    // Numerics.
    constexpr int kTried = 6; // radiances, each thrice the last

    const double was = radiance_[piece];
    std::vector<uint8_t> isLit(light_.size(), 0);
    double share = 0.0;
    for (const LitPlace place : lit_[piece]) {
        const auto direct = static_cast<double>(place.direct);
        const uint32_t i = place.place;
        isLit[i] = 1;
        share += direct / (light_[i] - was * direct);
    }
    if (share <= 0.0) return 0.0;
    std::vector<size_t> changed;
    for (size_t k = 0; k < fit_.pairs_.size(); ++k)
        if ((isLit[fit_.pairs_[k].p] | isLit[fit_.pairs_[k].q]) != 0) changed.push_back(k);
    std::vector<double> logAlbedo = logAlbedo_;
    const auto residual = [&](MaterialPair pair) { return logAlbedo[pair.p] - logAlbedo[pair.q]; };
    const auto nats = [&](double r) {
        for (const auto [i, direct] : lit_[piece])
            logAlbedo[i] =
                fit_.logShown_[i] - std::log(light_[i] + (r - was) * static_cast<double>(direct));
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
    double least = 0.0; // log of the first that is more than what it sends
    double r = 0.01 * static_cast<double>(light_.size()) / share; // 1 % of the light at places
    for (int tried = 0; tried < kTried; ++tried, r *= 3.0) {
        if (r < was) continue;
        if (least == 0.0) least = std::log(r);
        const double gained = without - nats(r);
        if (gained > most) {
            most = gained;
            best = std::log(r);
        }
    }
    const size_t own = fit_.model_.placeOf(piece);
    const double lack =
        fit_.boundCost(piece, std::log(fit_.irradiance(radiance_, own, own + 1).front()));
    if (most == 0.0 && lack > 0.0) best = least; // it is for its own light alone that it emits
    return most + lack;
}

} // namespace relamp
