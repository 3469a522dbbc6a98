#pragma once

#include "scan/rays.h"
#include "scan/texels.h"

#include <array>

namespace relamp
{

/// Pixels of a page that a point of the surface lies between, and how much it has of each.
struct PixelMix
{
    uint32_t page = 0;
    std::array<uint32_t, 4> pixel{};
    std::array<float, 4> weight{}; // sums to 1

    /// The pixel that has most of it.
    [[nodiscard]] uint32_t nearest() const;
};

/// Where on its page a ray met the scan: bilinear in a texture, barycentric between vertices.
PixelMix pixelsAt(const Texels& texels, const Hit& hit);

/// Shading normal at a hit, unit, on the side that the triangle faces.
glm::vec3 normalAt(const Texels& texels, const Hit& hit);

} // namespace relamp
