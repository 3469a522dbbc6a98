#pragma once

#include "rooms/atlas.h"
#include "rooms/bake.h"

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp::rooms
{

/// A room's atlas as a camera shows it, and what is true of it in the same units.
struct Photograph
{
    glm::vec3 scale{1.0f};        // units of the texture a unit of the room's radiance
    std::vector<glm::vec3> seen;  // linear, before anything burns out; charts go on as in `encoded`
    std::vector<uint8_t> encoded; // 8-bit sRGB, 3 a pixel; charts go on around their edges
    std::vector<uint8_t> mask;    // of pixels: 255 where an estimate is scored, else 0
};

/// Exposes a room so that a share of its surfaces other than lamps burns out, half balanced for the
/// colour of its light, as cameras do. Neither lamps nor hidden places are scored, nor the rims of
/// charts.
Photograph photograph(const Atlas& atlas, const Baked& baked, float burntOut);

} // namespace relamp::rooms
