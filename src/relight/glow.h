#pragma once

#include "lights/surfel_radiance.h"
#include "relight/transport.h"
#include "scan/texels.h"
#include "shading/lamp_sight.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// What direct light makes the surfaces of a room send, before anything bounces.
struct SentLight
{
    double flux = 0.0; // luminance * m^2
    double area = 0.0; // m^2
};
/// `albedo` is one a surfel, `direct` irradiance straight from lights, one a side.
SentLight sentDirectly(const Transport& transport, const Surfels& surfels,
                       std::span<const glm::vec3> albedo, std::span<const glm::vec3> direct);

/// The small part of a room that a light makes so bright that rays find it by chance: what a spot
/// or the sun falls on. It can be looked for as a lamp is.
struct Glow
{
    std::vector<uint32_t> sides; // of the transport, ascending
    // One a side. `area` is shared out by the luminance that they send, so that evenly spread rays
    // go where light comes from; `radiance` is the colour, at luminance 1 / pi.
    std::vector<ClippedPatch> patches;
    float gain = 0.0f; // on these radiances, at emission 1
};

/// Nothing where a light makes no small part bright, or none that matters among all that is sent.
/// `ofLight` is what sides receive at emission 1. The patches do not depend on the emission.
std::optional<Glow> findGlow(const Transport& transport, const Texels& texels,
                             std::span<const glm::vec3> albedo, const LampSight& ofLight,
                             glm::vec3 emission, const SentLight& all);

/// Irradiance from a glow at emission 1 on fronts of surfels, each of which sees a share of it.
std::vector<glm::vec3> irradianceFrom(const Glow& glow, const Transport& transport,
                                      const Surfels& surfels, std::span<const float> shares);

} // namespace relamp
