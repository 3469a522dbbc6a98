#pragma once

#include "fit/lamps.h"
#include "fit/reliability.h"
#include "fit/sun.h"
#include "lights/glow_marks.h"
#include "lights/shining.h"
#include "relamp/delight.h"
#include "scan/texels.h"
#include "shading/hit_lists.h"
#include "shading/lit_sides.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace relamp
{

/// A scan whose lamps are known: where the solvers start that shade by area and shadow.
struct FoundRoom
{
    Linearization linearization;    // of the texture
    GlowMarks glowing;              // texels of lamps that are not burnt out, but count so below
    std::vector<float> glowsFrom;   // Shining::glowsFrom of them
    SurfelRadiance radiance;        // by it
    std::vector<glm::vec3> texture; // what SurfelRadiance::plain was without it; empty: the same
    GatherOptions options;          // with what was left open filled in
    double rooms = 1.0;             // that there are: roomsOf()
    HitLists hits;
    FoundLamps found;     // or as a person gave them
    bool isGiven = false; // the latter
    Tempering tempering;  // of its shading
    LitSides sides;       // the light as the texture tells it
    std::vector<std::string> warnings;
};

/// What a lamp does at radiance 1, one a hit list; the sun comes behind all lamps.
const LampSight& onSidesOf(const FoundRoom& room, size_t lamp);

/// Irradiance from lamps and sun, one a hit list.
std::vector<glm::vec3> directOf(const FoundRoom& room);

/// The light at all sides under the room's powers; `settled` as lightSides().
LitSides sidesOf(const Texels& texels, const FoundRoom& room, std::optional<Gathered> settled = {});

/// Marks the surfels whose burnt-out texels belong to a lamp that shines under `powers`, or are a
/// patch of sun.
std::vector<uint8_t> shinesOf(const FoundRoom& room, const LampPowers& powers);

/// The texels that are a lamp's own; a patch of sun is not.
Shining shiningOf(const FoundRoom& room);

/// Variances of the logarithm of what surfels show, for the camera's response is not known better;
/// as reliabilityOf() takes it.
std::vector<float> varianceOfCamera(const FoundRoom& room);

} // namespace relamp
