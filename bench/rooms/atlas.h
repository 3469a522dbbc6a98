#pragma once

#include "relamp/scan.h"
#include "rooms/room.h"

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace relamp::rooms
{

constexpr int kPadding = 2; // pixels around a chart that are no other's

/// A piece of a patch and the rectangle of the texture that shows it.
struct Chart
{
    Patch patch; // of this piece alone
    glm::ivec2 corner{0};
    glm::ivec2 pixels{0}; // >= 1 each
};

/// Where on a texture of side x side pixels everything is. No two charts' padding meets.
struct Atlas
{
    int side = 0;
    std::vector<Chart> charts;

    [[nodiscard]] size_t pixels() const
    {
        return static_cast<size_t>(side) * static_cast<size_t>(side);
    }
};

/// Cuts patches into pieces of at most 1.5 m, as unwrappers do, and lays them out as large as they
/// fit, all to one scale.
Atlas layOut(const Room& room, int side);

/// A mesh of all charts. Texel (i, j) of a chart shows its patch at ((i + 0.5, j + 0.5) / pixels).
struct ChartMesh
{
    Scan scan;
    std::vector<uint32_t> chartOf; // triangles
};

constexpr float kWhole = 1e3f; // m: no flat chart is cut

/// Flat charts are cut into cells of about `cell` metres, spheres at least into a few; the page is
/// white.
ChartMesh meshOf(const Atlas& atlas, float cell);

} // namespace relamp::rooms
