#pragma once

#include "relamp/response.h"

#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// What makes radiance of the linear values of a scan's textures.
struct Linearization
{
    Response response;              // first this
    std::vector<glm::vec3> perGain; // then this factor, one a surfel; empty: 1

    [[nodiscard]] bool isNeutral() const { return response.isStraight() && perGain.empty(); }
};

} // namespace relamp
