#pragma once

#include "relight/transport.h"

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Light that comes by way of surfaces and from the sky.
struct Bounced
{
    std::vector<glm::vec3> irradiance; // on fronts of surfels
    std::vector<float> noise;          // standard error of its luminance
    size_t bounces = 0;                // that were followed; the rest is the sum of their series
};

/// What some sides send of their own direct light, where that is known better than by the rays that
/// happen to meet them.
struct KnownLight
{
    std::span<const glm::vec3> direct;     // on sides: the part of their direct light; empty: none
    std::span<const glm::vec3> irradiance; // by what they send of it, on fronts of surfels
};

/// All bounces of the light in a room of matte surfaces: radiance <- albedo / pi * irradiance,
/// until what is left is less than can be seen.
///
/// `albedo` is one a surfel, both sides of it, 0..1; `direct` irradiance straight from lights, one
/// a side of the transport; `sky` the radiance of SkyBins. The result is without what is known.
Bounced bounce(const Transport& transport, std::span<const glm::vec3> albedo,
               std::span<const glm::vec3> direct, std::span<const glm::vec3> sky,
               const KnownLight& known = {});

} // namespace relamp
