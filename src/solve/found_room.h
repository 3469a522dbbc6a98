#pragma once

#include "fit/lamps.h"
#include "relamp/delight.h"
#include "scan/rays.h"
#include "scan/texels.h"
#include "shading/hit_lists.h"
#include "shading/lit_sides.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace relamp
{

/// As fine as light changes on walls; coarse for a draft.
SurfelOptions surfelsOf(Quality quality);

/// A scan whose lamps are known: where the solvers start that shade by area and shadow.
struct FoundRoom
{
    SurfelRadiance radiance;
    GatherOptions options; // with what was left open filled in
    HitLists hits;
    FoundLamps found;            // or as a person gave them
    std::vector<uint8_t> shines; // of surfels; not 0: its burnt-out texels are a lamp's
    std::vector<std::string> warnings;
};

/// Finds the lamps and their radiances by what they do to the walls; where the options name
/// lights, it is these.
FoundRoom findRoom(const Texels& texels, const RayScene& scene, const DelightOptions& options,
                   Progress& progress);

/// The light in a room as its texture tells it. Lamps that were not looked at yet are now.
LitSides litSidesOf(const Texels& texels, const RayScene& scene, FoundRoom& room);

/// Lamps as people see and edit them.
Lights lightsOf(const FoundLamps& found);

/// Albedo for texels that cannot be trusted, one a surfel. Those that are mostly burnt out do not
/// know their own and get that of the surface around them.
std::vector<glm::vec3> fillOf(const Surfels& surfels, const SurfelRadiance& radiance,
                              std::span<const glm::vec3> albedo);

} // namespace relamp
