#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

inline bool isDark(glm::vec3 light)
{
    return std::max({light.r, light.g, light.b}) <= 0.0f;
}

/// Which texels are a lamp's own surface: the bright ones of the surfels that hold a part of one.
struct Shining
{
    std::vector<uint8_t> surfels; // not 0: holds a part of a lamp
    float threshold = 0.0f;       // luminance from which a burnt-out texel of them shines
};

} // namespace relamp
