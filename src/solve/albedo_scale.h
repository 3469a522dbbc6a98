#pragma once

#include "lights/surfel_radiance.h"
#include "solve/cross_validation.h"
#include "solve/found_room.h"

#include <span>

#include <glm/vec3.hpp>

namespace relamp
{

/// Scales the shading of a room as a whole. Where a person called something white, so that it has
/// the albedo of white paper, in the mean of its logarithms; else as rooms are painted, as far as
/// places of one paint differ. `irradiance`: of surfels, with all that corrects it; `proof`: how
/// much albedo differs under it. Nothing is done where lights are given, or none is believed in.
void scaleAlbedo(std::span<const glm::vec3> irradiance, const CrossValidation& proof,
                 FoundRoom& room);

/// What is to be added to the logarithm of a room's light; below 0 there was too much.
struct LackingLight
{
    float log = 0.0f;   // the likeliest, -1..1.5
    float error = 0.0f; // standard error of that: no more than |log|
};

/// So that a room is as bright as rooms are, and paint is no whiter than white paint. `albedo`: of
/// surfels by the light that was found, the brightest channel, finite; `light`: what each receives,
/// in any unit, >= 0; `placesDiffer`: log, of albedo from place to place of one paint.
LackingLight lackingLight(std::span<const float> albedo, std::span<const float> light,
                          float placesDiffer);

} // namespace relamp
