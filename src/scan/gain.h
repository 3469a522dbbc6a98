#pragma once

#include "relamp/camera_model.h"

#include <array>
#include <cstdint>

namespace relamp
{

/// The eight knots around a place, and their parts in it, which sum up to 1.
struct GainWeights
{
    std::array<uint32_t, 8> knot;
    std::array<float, 8> part;
};

GainWeights weightsAt(const Gain& gain, glm::vec3 position);

} // namespace relamp
