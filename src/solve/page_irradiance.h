#pragma once

#include "gpu/compute.h"
#include "shading/texel_shading.h"

#include <cstddef>
#include <vector>

namespace relamp
{

/// Where in the atlas a block of texels lies.
struct TexelsAt
{
    size_t page;
    size_t begin; // first texel
};

/// Irradiance on the texels of a page as a GPU has found it: RGB as halves in two numbers.
struct PageIrradiance
{
    std::vector<glm::uvec2> direct;
    std::vector<glm::uvec2> indirect;

    /// That of texels [begin, begin + count).
    void copy(size_t begin, size_t count, ShadingBlock& out) const
    {
        copy(direct, begin, count, out.direct);
        copy(indirect, begin, count, out.indirect);
    }

private:
    static void copy(const std::vector<glm::uvec2>& from, size_t begin, size_t count, RgbBlock& to)
    {
        for (size_t i = 0; i < count; ++i) {
            const glm::vec4 rgb = halves(from[begin + i]);
            to.r[i] = rgb.r;
            to.g[i] = rgb.g;
            to.b[i] = rgb.b;
        }
    }
};

} // namespace relamp
