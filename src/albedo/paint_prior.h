#pragma once

#include "lights/surfel_radiance.h"
#include "scan/surfels.h"
#include "shading/enclosed_texels.h"

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

/// What surfels show, and the light that falls on each.
struct LitSurfels
{
    const Surfels& surfels;
    const SurfelRadiance& radiance;
    std::span<const glm::vec3> irradiance;
    std::span<const Rim> rims; // empty: none has one
};

/// The same for texels that cannot be trusted, by divided radiance. Surfels that are mostly burnt
/// out, or much whiter than paper in this light, do not know their own albedo and get that of the
/// surface around them. `darkest`: shading that tells no paint, as AlbedoOptions has it.
std::vector<glm::vec3> paintUnder(const LitSurfels& lit, std::span<const float> variance,
                                  float darkest);

} // namespace relamp
