#pragma once

#include <cstdint>
#include <vector>

namespace relamp
{

/// Which texels are a lamp's own surface: the bright ones of the surfels that hold a part of one.
struct Shining
{
    std::vector<uint8_t> surfels; // not 0: holds a part of a lamp
    float threshold = 0.0f;       // luminance from which a burnt-out texel of them shines
};

} // namespace relamp
