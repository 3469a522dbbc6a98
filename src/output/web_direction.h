#pragma once

#include "scan/site.shared.h"

#include <cmath>
#include <cstdint>

namespace relamp
{

/// A unit vector in two bytes, to about a degree: octahedral, x in the lower one, -1..1 as 0..255.
inline uint16_t webDirection(glm::vec3 direction)
{
    const glm::vec2 square = 127.5f * (octahedral(direction) + 1.0f);
    return static_cast<uint16_t>(std::lround(square.x) | std::lround(square.y) << 8);
}

inline glm::vec3 fromWebDirection(uint16_t bytes)
{
    return fromOctahedral(
        glm::vec2(static_cast<float>(bytes & 255), static_cast<float>(bytes >> 8)) / 127.5f - 1.0f);
}

} // namespace relamp
