#pragma once

#include <optional>
#include <span>

#include <glm/vec3.hpp>

namespace relamp
{

/// What is known at one place of the scan before the parameters are set.
struct ParameterSample
{
    glm::vec3 radiance{0.0f}; // mean of unclipped texels there
    glm::vec3 shading{0.0f};  // irradiance / pi of all lights and bounces at power 1
    float area = 0.0f;        // m^2
};

struct FittedParameters
{
    float power = 1.0f;   // factor on the shading of all lights and bounces
    float ambient = 0.0f; // irradiance / pi, in the texture's units
};

/// Sets the two parameters that Choi leaves to the eye: how bright the lights are, and how much
/// ambient light there is beside them: shading = power * sample.shading + ambient.
///
/// Their ratio is the one that makes the albedo most uniform: least spread (interquartile range) of
/// log radiance / shading over the room, weighted by area and radiance, for what hides in the dark
/// says little of lamps that cast no shadow. Their size makes the brightest of the room's albedo
/// 0.87, its 98th percentile: the anchor is a white thing somewhere in the room. A parameter that
/// is given is kept, and the other follows: ambient by the spread, power by the anchor. Without
/// samples, power is 1.
FittedParameters fitParameters(std::span<const ParameterSample> samples, std::optional<float> power,
                               std::optional<float> ambient);

} // namespace relamp
