#pragma once

#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// What a person may tell the default solver; it needs none of it.
struct GatherOptions
{
    int rays = 0;       // of a surfel, that look for bounce light, 4..1024; 0: as the scan is fine
    int shadowRays = 8; // of a place in a penumbra, to each lamp, 1..1024
    std::vector<glm::vec3> lights;    // places, m, whose burnt-out surface shines
    std::vector<glm::vec3> notLights; // places, m, whose burnt-out surface does not
};

} // namespace relamp
