#pragma once

#include <optional>
#include <span>

#include <glm/vec3.hpp>

namespace relamp
{

/// What is known at one place of the scan before the dials are set.
struct DialSample
{
    glm::vec3 radiance{0.0f}; // mean of unclipped texels there
    glm::vec3 shading{0.0f};  // irradiance / pi of all lights and bounces at power 1
    float area = 0.0f;        // m^2
};

struct Dials
{
    float power = 1.0f;
    float ambient = 0.0f; // in units of `power` 1: to be multiplied by it
};

/// Sets the two dials that Choi leaves to the eye: how much ambient light there is beside the lights,
/// and how bright both are.
///
/// Ambient is what makes the albedo most uniform: least spread (interquartile range, by area) of
/// log radiance / shading over the room. Power makes the brightest of the room's albedo 0.9, its 98th
/// percentile: the anchor is a white thing somewhere in the room. Without light, power is 1.
/// An ambient that is given is kept, and power follows it.
Dials fitDials(std::span<const DialSample> samples, std::optional<float> ambient = {});

} // namespace relamp
