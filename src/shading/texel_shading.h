#pragma once

#include "scan/texels.h"

#include <functional>

namespace relamp
{

/// Shading of a block of texels: irradiance / pi. Entries behind its last texel are unspecified.
struct ShadingBlock
{
    RgbBlock direct;
    RgbBlock indirect; // by way of other surfaces, and ambient
};

/// What every solver ends in: shades texels [begin, begin + block.count) of a page. The block comes
/// with geometry and surfels loaded. Thread safe.
using TexelShading =
    std::function<void(size_t page, size_t begin, const TexelBlock& block, ShadingBlock& out)>;

} // namespace relamp
