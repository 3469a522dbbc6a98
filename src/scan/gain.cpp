#include "scan/gain.h"

#include "base/radiometry.shared.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace relamp
{

GainWeights weightsAt(const Gain& gain, glm::vec3 position)
{
    const glm::vec3 at = (position - gain.origin) / gain.spacing;
    GainWeights weights{};
    weights.part.fill(1.0f);
    uint32_t stride = 1;
    for (size_t axis = 0; axis < 3; ++axis) {
        const int last = gain.count[axis] - 1;
        const float along = std::clamp(at[static_cast<int>(axis)], 0.0f, static_cast<float>(last));
        const int low = std::min(static_cast<int>(along), std::max(last - 1, 0));
        const float beyond = along - static_cast<float>(low);
        for (uint32_t corner = 0; corner < 8; ++corner) {
            const bool isHigh = (corner >> axis & 1u) != 0;
            weights.part[corner] *= isHigh ? beyond : 1.0f - beyond;
            weights.knot[corner] += stride * static_cast<uint32_t>(std::min(low + isHigh, last));
        }
        stride *= static_cast<uint32_t>(gain.count[axis]);
    }
    return weights;
}

Gain latticeOver(std::span<const glm::vec3> position, float spacing, int mostKnots)
{
    if (position.empty()) return {};
    glm::vec3 low = position[0];
    glm::vec3 high = position[0];
    for (const glm::vec3 p : position) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    Gain gain{.spacing = spacing};
    glm::ivec3 count(0);
    const auto fits = [&] {
        const glm::vec3 steps = glm::ceil((high - low) / gain.spacing);
        if (std::max({steps.x, steps.y, steps.z}) >= static_cast<float>(mostKnots)) return false;
        count = glm::ivec3(steps) + 1;
        return int64_t{count.x} * count.y * count.z <= mostKnots;
    };
    while (!fits()) gain.spacing *= 1.1f;
    gain.origin = 0.5f * (low + high - gain.spacing * glm::vec3(count - 1));
    gain.count = {count.x, count.y, count.z};
    gain.log.assign(static_cast<size_t>(count.x * count.y * count.z), glm::vec3(0.0f));
    return gain;
}

Gain meansOver(Gain lattice, std::span<const glm::vec3> position, std::span<const float> log,
               std::span<const float> weight)
{
    std::vector<float> sum(lattice.log.size(), 0.0f);
    std::vector<float> parts(lattice.log.size(), 0.0f);
    for (size_t i = 0; i < position.size(); ++i) {
        const GainWeights weights = weightsAt(lattice, position[i]);
        for (size_t k = 0; k < weights.knot.size(); ++k) {
            sum[weights.knot[k]] += weights.part[k] * weight[i] * log[i];
            parts[weights.knot[k]] += weights.part[k] * weight[i];
        }
    }
    for (size_t k = 0; k < sum.size(); ++k)
        lattice.log[k] = glm::vec3(parts[k] > 0.0f ? sum[k] / parts[k] : 0.0f);
    return lattice;
}

float Gain::stops() const
{
    if (isOne()) return 0.0f;
    const auto darker = [](glm::vec3 a, glm::vec3 b) { return luminance(a) < luminance(b); };
    const auto [least, most] = std::minmax_element(log.begin(), log.end(), darker);
    return luminance(*most - *least) / std::log(2.0f);
}

float CameraModel::stops() const
{
    float most = 0.0f;
    for (const Gain& gain : gains) most = std::max(most, gain.stops());
    return most;
}

glm::vec3 logAt(const Gain& gain, glm::vec3 position)
{
    glm::vec3 sum(0.0f);
    if (gain.isOne()) return sum;
    const GainWeights weights = weightsAt(gain, position);
    for (size_t k = 0; k < weights.knot.size(); ++k)
        sum += weights.part[k] * gain.log[weights.knot[k]];
    return sum;
}

glm::vec3 Gain::at(glm::vec3 position) const
{
    return glm::exp(logAt(*this, position));
}

} // namespace relamp
