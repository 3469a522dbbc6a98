#pragma once

#include "fit/light_model.h"
#include "relamp/camera_model.h"

#include <span>

#include <glm/vec3.hpp>

namespace relamp
{

/// What places of a scan show in its file, and where they lie.
struct TexturePlaces
{
    std::span<const glm::vec3> texture; // linear
    std::span<const glm::vec3> position;
};

/// The slopes of the response, less 1, as unknowns beside the light.
CameraColumns columnsOf(const Response& known, const TexturePlaces& places);
Response responseOf(std::span<const double> coefficients);

/// A gain of 1 over these places; without knots where they lie too close together for one.
Gain evenGainOver(std::span<const glm::vec3> position);

/// The logarithms of the gain's knots as unknowns beside the light.
CameraColumns columnsOf(const Gain& known, const TexturePlaces& places);
Gain gainOf(Gain lattice, std::span<const double> coefficients);

} // namespace relamp
