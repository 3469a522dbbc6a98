#pragma once

#include "shading/outside_light.h"

#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// The unknowns of a room's light, RGB, 1 = the texture's white.
struct LampPowers
{
    std::vector<glm::vec3> lamps; // radiance of each; of a sun last
    OutsideLight outside;

    bool operator==(const LampPowers&) const = default;
};

} // namespace relamp
