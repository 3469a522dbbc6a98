#pragma once

#include "scan/rays.h"
#include "scan/texels.h"

#include <array>

namespace relamp
{

/// The pixel of a page that a point of the surface lies on.
struct PixelAt
{
    uint32_t page = 0;
    uint32_t pixel = 0;
};
PixelAt nearestPixelAt(const Texels& texels, const Hit& hit);

/// Pixels of a page that a point of the surface lies between, and how much it has of each.
struct PixelMix
{
    uint32_t page = 0;
    std::array<uint32_t, 4> pixel{};
    std::array<float, 4> weight{}; // sums to 1
};

/// Where on its page a ray met the scan: bilinear in a texture, barycentric between vertices.
PixelMix pixelsAt(const Texels& texels, const Hit& hit);

/// Shading normal at a hit, unit, on the side that the triangle faces.
glm::vec3 normalAt(const Texels& texels, const Hit& hit);

} // namespace relamp
