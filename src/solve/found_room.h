#pragma once

#include "fit/lamps.h"
#include "fit/reliability.h"
#include "fit/sun.h"
#include "lights/glow_marks.h"
#include "lights/shining.h"
#include "relamp/delight.h"
#include "scan/rays.h"
#include "scan/texels.h"
#include "shading/enclosed_texels.h"
#include "shading/hit_lists.h"
#include "shading/lit_sides.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace relamp
{

/// As fine as light changes on walls; coarse for a draft. separateEnclosed has to follow.
SurfelOptions surfelsOf(const GatherOptions& options);

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

/// Finds the lamps and their radiances by what they do to the walls, and the sun by the patch that
/// it throws; where something glows that is not burnt out, it is a lamp, and all is found again.
/// Where the options name lights, nothing is searched and it is these: the fixtures of their file
/// on the surfaces that have their numbers. All lamps have been looked at. `before`: the same
/// texels under other options, or null; where as many rays are wanted, what they met is taken from
/// there.
FoundRoom findRoom(const Texels& texels, const RayScene& scene, const DelightOptions& options,
                   Progress& progress, const FoundRoom* before = nullptr);

/// Lamps and the sun as people see and edit them: as bright as the scaled shading says, where
/// LampPowers are those before the scale.
Lights lightsOf(const FoundRoom& room);
/// The same as LampPowers has them. Throws Error(malformed) where the scale is not above 0.
Lights beforeScale(Lights lights);

/// The large holes of the scan, with the light that comes in.
std::vector<Opening> openingsOf(const FoundRoom& room);

/// What a lamp does at radiance 1, one a hit list; the sun comes behind all lamps.
const LampSight& onSidesOf(const FoundRoom& room, size_t lamp);

/// Irradiance from lamps and sun, one a hit list.
std::vector<glm::vec3> directOf(const FoundRoom& room);

/// The light at all sides under the room's powers; `settled` as lightSides().
LitSides sidesOf(const Texels& texels, const FoundRoom& room, std::optional<Gathered> settled = {});

/// Marks the surfels whose burnt-out texels belong to a lamp that shines under `powers`, or are a
/// patch of sun.
std::vector<uint8_t> shinesOf(const FoundRoom& room, const LampPowers& powers);

/// Whose the burnt-out texels of each surfel are, as fixtureMapOf() takes it; lamps that are off
/// have theirs, a patch of sun has none.
std::vector<int32_t> fixturesOfSurfels(const FoundRoom& room);

/// The texels that are a lamp's own; a patch of sun is not.
Shining shiningOf(const FoundRoom& room);

/// Variances of the logarithm of what surfels show, for the camera's response is not known better;
/// as reliabilityOf() takes it.
std::vector<float> varianceOfCamera(const FoundRoom& room);

/// Albedo for texels that cannot be trusted, one a surfel: paintAround() by the `doubt` of their
/// light. Those that are mostly burnt out, or much whiter than paper in this light, do not know
/// their own and get that of the surface around them.
std::vector<glm::vec3> fillOf(const Surfels& surfels, const SurfelRadiance& radiance,
                              std::span<const glm::vec3> irradiance, std::span<const float> doubt,
                              std::span<const Rim> rims, float darkest);

} // namespace relamp
