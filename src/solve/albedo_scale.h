#pragma once

#include "lights/surfel_radiance.h"
#include "solve/found_room.h"

#include <span>

#include <glm/vec3.hpp>

namespace relamp
{

/// Scales the shading of a room as a whole. Where a person called something white, so that it has
/// the albedo of white paper, in the mean of its logarithms; else by how much brighter the light
/// must have been than what was found, for surfaces not to be whiter than paper. `irradiance`: of
/// surfels, with all that corrects it. Nothing is done where lights are given, or none is believed
/// in.
void scaleAlbedo(std::span<const glm::vec3> irradiance, FoundRoom& room);

/// What is to be added to the logarithm of a room's light.
struct LackingLight
{
    float log = 0.0f;   // the likeliest, >= 0
    float error = 0.0f; // standard error of that: no more than the whole
};

/// So that paint is no whiter than paper. `albedo`: of surfels by the light that was found, the
/// brightest channel; `light`: what each receives, in any unit, >= 0.
LackingLight lackingLight(std::span<const float> albedo, std::span<const float> light);

} // namespace relamp
