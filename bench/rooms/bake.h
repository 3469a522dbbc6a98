#pragma once

#include "rooms/atlas.h"
#include "rooms/room.h"

#include <cstdint>
#include <vector>

namespace relamp::rooms
{

struct BakeOptions
{
    int lampRays = 64;   // a texel and lamp or opening, >= 1
    int bounceRays = 96; // a texel, >= 1
    uint64_t seed = 1;
};

/// What is true of every pixel of an atlas. Linear RGB in the room's own radiance; 0 where no chart
/// is. Irradiance is divided by pi: a matte surface shows albedo * (direct + indirect) + emission.
struct Baked
{
    std::vector<glm::vec3> albedo;
    std::vector<glm::vec3> direct;   // straight from lamps
    std::vector<glm::vec3> indirect; // by way of surfaces, and from outside
    std::vector<glm::vec3> emission;
    std::vector<uint8_t> isCovered;
    std::vector<uint8_t> isHidden; // behind or under something that touches it: black

    [[nodiscard]] glm::vec3 radiance(size_t pixel) const
    {
        return albedo[pixel] * (direct[pixel] + indirect[pixel]) + emission[pixel];
    }
};

/// Light of a room with all its bounces, by means other than the solvers': rays from everywhere in
/// a texel to points on lamps and openings and in directions of chance, each find weighted by how
/// much its way is the better one (Veach & Guibas 1995, balance heuristic); then bounces between
/// texels along the rays of chance until nothing changes. The same on any number of threads.
Baked bake(const Room& room, const Atlas& atlas, const BakeOptions& options);

} // namespace relamp::rooms
