#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
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
    // Of surfels: luminance from which a texel that is not burnt out does, too; empty: none does
    std::vector<float> glowsFrom{};

    [[nodiscard]] float glowsFromOf(size_t surfel) const
    {
        return glowsFrom.empty() ? std::numeric_limits<float>::infinity() : glowsFrom[surfel];
    }
};

} // namespace relamp
