#pragma once

#include "relamp/camera_model.h"

#include <array>
#include <cstdint>
#include <span>

namespace relamp
{

/// The eight knots around a place, and their parts in it, which sum up to 1.
struct GainWeights
{
    std::array<uint32_t, 8> knot;
    std::array<float, 8> part;
};

GainWeights weightsAt(const Gain& gain, glm::vec3 position);
/// Logarithm of Gain::at(); 0 where the gain is 1.
glm::vec3 logAt(const Gain& gain, glm::vec3 position);

/// A gain of 1 on a lattice over these places, whose knots lie `spacing` m apart; farther where
/// that would be more than `mostKnots` >= 1.
Gain latticeOver(std::span<const glm::vec3> position, float spacing, int mostKnots);

/// The lattice with means of `log` at its knots, by weight and nearness; 0 at knots that none is
/// near.
Gain meansOver(Gain lattice, std::span<const glm::vec3> position, std::span<const float> log,
               std::span<const float> weight);

} // namespace relamp
