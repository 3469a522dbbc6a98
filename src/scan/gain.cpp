#include "scan/gain.h"

#include <algorithm>
#include <cmath>

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

float Gain::stops() const
{
    if (isOne()) return 0.0f;
    const auto [least, most] = std::minmax_element(log.begin(), log.end());
    return (*most - *least) / std::log(2.0f);
}

float Gain::at(glm::vec3 position) const
{
    if (isOne()) return 1.0f;
    const GainWeights weights = weightsAt(*this, position);
    float sum = 0.0f;
    for (size_t k = 0; k < weights.knot.size(); ++k) sum += weights.part[k] * log[weights.knot[k]];
    return std::exp(sum);
}

} // namespace relamp
