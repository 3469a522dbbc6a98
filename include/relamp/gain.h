#pragma once

#include "relamp/api.h"

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// How much brighter a texture shows the places of a scan than others, for the camera's exposure
/// and white balance drifted: logarithms on a lattice in space, trilinear between its knots and
/// constant beyond.
struct RELAMP_API Gain
{
    glm::vec3 origin{0.0f};                          // world, m: of the first knot
    float spacing = 1.0f;                            // m, > 0
    int countX = 0, countY = 0, countZ = 0;          // knots along each axis; 0: no gain at all
    std::vector<glm::vec3> log;                      // RGB; x fastest, then y, then z

    bool operator==(const Gain&) const = default;

    [[nodiscard]] bool isOne() const { return log.empty(); }
    /// RGB, > 0.
    [[nodiscard]] glm::vec3 at(glm::vec3 position) const;
};

} // namespace relamp
