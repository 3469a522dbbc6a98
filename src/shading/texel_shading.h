#pragma once

#include "scan/texels.h"

#include <algorithm>
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

/// A TexelShading: 1 everywhere, all of it indirect.
inline void evenShading(size_t /*page*/, size_t /*begin*/, const TexelBlock& block,
                        ShadingBlock& out)
{
    for (float* channel : {out.direct.r, out.direct.g, out.direct.b})
        std::fill_n(channel, block.count, 0.0f);
    for (float* channel : {out.indirect.r, out.indirect.g, out.indirect.b})
        std::fill_n(channel, block.count, 1.0f);
}

} // namespace relamp
