#pragma once

#include "scan/rays.h"
#include "scan/texels.h"

#include <array>
#include <vector>

namespace relamp
{

/// The pixel of a page that a point of the surface lies on.
struct PixelAt
{
    uint32_t page = 0;
    uint32_t pixel = 0;
};
PixelAt nearestPixelAt(const Texels& texels, const Hit& hit);

/// The same for many hits: where every triangle lies on its page is worked out once.
class NearestPixels
{
public:
    explicit NearestPixels(const Texels& texels);

    [[nodiscard]] PixelAt at(const Hit& hit) const;

private:
    /// Pixel corner + weights.x * second + weights.y * third is the nearest where it lies on the
    /// page, from 0 to below `end`.
    struct OnPage
    {
        glm::vec2 corner{0.0f};
        glm::vec2 second{0.0f};
        glm::vec2 third{0.0f};
        glm::vec2 end{0.0f}; // 0: ask nearestPixelAt
        uint32_t page = 0;
        uint32_t width = 0;
    };

    const Texels& texels_;
    std::vector<OnPage> triangles_;
};

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
