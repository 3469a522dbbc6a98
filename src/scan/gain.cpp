#include "scan/gain.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace relamp
{

GainWeights weightsAt(const Gain& gain, glm::vec3 position)
{
    const glm::vec3 last(static_cast<float>(gain.countX - 1), static_cast<float>(gain.countY - 1),
                         static_cast<float>(gain.countZ - 1));
    const glm::vec3 at =
        glm::clamp((position - gain.origin) / gain.spacing, glm::vec3(0.0f), last);
    GainWeights weights{};
    for (uint32_t corner = 0; corner < 8; ++corner) {
        float part = 1.0f;
        std::array<uint32_t, 3> knot{};
        for (int axis = 0; axis < 3; ++axis) {
            const float low = std::floor(at[axis]);
            const bool isHigh = (corner >> axis & 1u) != 0;
            part *= isHigh ? at[axis] - low : 1.0f - (at[axis] - low);
            knot[static_cast<size_t>(axis)] =
                static_cast<uint32_t>(std::min(low + (isHigh ? 1.0f : 0.0f), last[axis]));
        }
        weights.knot[corner] = knot[0] + static_cast<uint32_t>(gain.countX) *
                                             (knot[1] + static_cast<uint32_t>(gain.countY) * knot[2]);
        weights.part[corner] = part;
    }
    return weights;
}

glm::vec3 Gain::at(glm::vec3 position) const
{
    if (isOne()) return glm::vec3(1.0f);
    const GainWeights weights = weightsAt(*this, position);
    glm::vec3 sum(0.0f);
    for (size_t k = 0; k < 8; ++k) sum += weights.part[k] * log[weights.knot[k]];
    return glm::exp(sum);
}

} // namespace relamp
