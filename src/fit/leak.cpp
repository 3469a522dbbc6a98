#include "fit/leak.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>

namespace relamp
{
namespace
{

constexpr std::array kLeaks{0.0, 0.0125, 0.025, 0.05, 0.1, 0.2}; // octaves, and none

} // namespace

double findLeak(const FitData& data, std::span<const MaterialPair> pairs,
                const PowersOptions& options)
{
    std::array<float, kLeaks.size()> surprise{};
    forEach(kLeaks.size(), [&](size_t i) {
        PowersOptions leaky = options;
        leaky.oneChannel = true;
        leaky.leak = kLeaks[i];
        surprise[i] = fitPowers(data, pairs, leaky).surprise;
    });
    const auto least = std::min_element(surprise.begin(), surprise.end());
    return kLeaks[static_cast<size_t>(least - surprise.begin())];
}

} // namespace relamp
