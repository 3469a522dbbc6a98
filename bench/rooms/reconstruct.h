#pragma once

#include "rooms/atlas.h"

#include <cstdint>

namespace relamp::rooms
{

struct ReconstructOptions
{
    float noise = 0.006f; // m, rms of where a vertex lies
    float holes = 0.03f;  // share of the surface that is missing, about
    uint64_t seed = 1;
};

/// The room's mesh as photogrammetry would have it: bumps about a hand wide, cracks where surfaces
/// meet, holes.
ChartMesh reconstructed(const Atlas& atlas, const ReconstructOptions& options);

} // namespace relamp::rooms
