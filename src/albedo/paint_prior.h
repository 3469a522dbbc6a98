#pragma once

#include "scan/surfels.h"

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Albedo of surfels by their own light, as far as it is trusted, and by what is of their paint
/// around them: the prior of the texels (drawnToPaint()). `variance`: of the logarithm of each
/// one's light. One that is not `isKnown` tells nothing of the others. Gaussian Markov field with
/// robust weights, a few Jacobi rounds.
std::vector<glm::vec3> paintAround(const Surfels& surfels, std::span<const glm::vec3> albedo,
                                   std::span<const uint8_t> isKnown,
                                   std::span<const float> variance);

} // namespace relamp
