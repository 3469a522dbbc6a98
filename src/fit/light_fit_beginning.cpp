#include "fit/light_fit.h"

#include <algorithm>
#include <cmath>

namespace relamp
{

std::vector<double> LightFit::beginning() const
{
    std::vector<double> log(model_.pieces, 0.0);
    for (size_t f = 0; f < model_.pieces; ++f) {
        double gathered = 0.0;
        double direct = 0.0;
        for (size_t i = 0; i < model_.places(); ++i) {
            gathered += gathered_[i];
            direct += static_cast<double>(model_.directAt(i)[f]);
        }
        if (direct > 0.0)
            log[f] =
                std::log(std::max(gathered / direct / static_cast<double>(model_.pieces), 1.0));
    }
    log.resize(model_.pieces + model_.outsides, outside_);
    for (size_t o = 1; o < model_.outsides; ++o) {
        if (model_.areSmallHoles(o)) continue;
        double gathered = 0.0;
        double missed = 0.0;
        for (size_t i = 0; i < model_.places(); ++i) {
            gathered += gathered_[i];
            missed += static_cast<double>(model_.missedAt(i)[o]);
        }
        if (missed > 0.0 && gathered > 0.0)
            log[model_.pieces + o] = std::max(
                outside_, std::log(gathered / missed / static_cast<double>(model_.outsides)));
    }
    return log;
}

} // namespace relamp
