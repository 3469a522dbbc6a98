#include "fit/light_fit.h"

#include <algorithm>
#include <cmath>

namespace relamp
{

std::vector<double> LightFit::beginning() const
{
    std::vector<double> log(model_.pieces, 0.0);
    double gathered = 0.0;
    std::vector<double> ofPieces(model_.pieces, 0.0);
    for (size_t i = 0; i < model_.places(); ++i) {
        gathered += gathered_[i];
        for (const auto [f, direct] : model_.direct[i]) ofPieces[f] += static_cast<double>(direct);
    }
    for (size_t f = 0; f < model_.pieces; ++f)
        if (ofPieces[f] > 0.0)
            log[f] = std::log(
                std::max(gathered / ofPieces[f] / static_cast<double>(model_.pieces), 1.0));
    log.resize(model_.pieces + model_.outsides, outside_);
    std::vector<double> missed(model_.outsides, 0.0);
    for (size_t i = 0; i < model_.places(); ++i)
        for (const auto [part, irradiance] : model_.missed[i])
            missed[part] += static_cast<double>(irradiance);
    for (size_t o = 1; o < model_.outsides; ++o)
        if (!model_.areSmallHoles(o) && missed[o] > 0.0 && gathered > 0.0)
            log[model_.pieces + o] = std::max(
                outside_, std::log(gathered / missed[o] / static_cast<double>(model_.outsides)));
    return log;
}

} // namespace relamp
