#include "fit/missed.h"

#include "base/parallel.h"

#include <algorithm>

namespace relamp
{
namespace
{

FitData without(const FitData& data, std::span<const uint8_t> gone)
{
    FitData less = data;
    less.lamps -= static_cast<size_t>(std::count(gone.begin(), gone.end(), 1));
    less.direct.clear();
    for (size_t i = 0; i < data.direct.size(); ++i)
        if (gone[i % data.lamps] == 0) less.direct.push_back(data.direct[i]);
    return less;
}

PowersOptions without(const PowersOptions& options, std::span<const uint8_t> gone)
{
    PowersOptions less = options;
    less.start.clear();
    for (size_t f = 0; f < options.start.size(); ++f)
        if (f >= gone.size() || gone[f] == 0) less.start.push_back(options.start[f]);
    std::vector<uint32_t> place(gone.size());
    for (uint32_t f = 0, kept = 0; f < gone.size(); ++f) place[f] = gone[f] != 0 ? 0 : kept++;
    less.alike.clear();
    for (const auto& [a, b, ratio] : options.alike)
        if (gone[a] == 0 && gone[b] == 0) less.alike.push_back({place[a], place[b], ratio});
    return less;
}

} // namespace

std::vector<float> missed(const FitData& data, std::span<const MaterialPair> pairs,
                          const PowersOptions& options, std::span<const std::vector<uint8_t>> gone)
{
    const float loss = fitPowers(data, pairs, options).loss;
    std::vector<float> rises(gone.size());
    forEach(gone.size(), [&](size_t i) {
        rises[i] = fitPowers(without(data, gone[i]), pairs, without(options, gone[i])).loss - loss;
    });
    return rises;
}

} // namespace relamp
