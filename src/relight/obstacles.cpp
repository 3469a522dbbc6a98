#include "relight/obstacles.h"

#include "scan/surface_point.h"

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr int kMostOpenings = 16;    // on one way; a window is scanned in layers
constexpr float kOffOpening = 1e-3f; // m

} // namespace

void Obstacles::blocked(std::span<const Ray> rays, std::span<uint8_t> blocked) const
{
    scene_.occluded(rays, blocked);
    if (isOpening_.empty()) return;
    for (size_t i = 0; i < rays.size(); ++i)
        if (blocked[i] != 0) blocked[i] = isBlocked(rays[i]) ? 1 : 0;
}

bool Obstacles::isBlocked(Ray ray) const
{
    for (int opening = 0; opening < kMostOpenings; ++opening) {
        const Hit hit = scene_.intersect(ray);
        if (hit.missed()) return false;
        const glm::vec3 place = ray.origin + hit.distance * ray.direction;
        const uint32_t surfel = texels_.surfels.find(place, normalAt(texels_, hit));
        const auto [page, pixel] = nearestPixelAt(texels_, hit);
        if (surfel == Surfels::kNone || isOpening_[surfel] == 0 || !isClipped_[page][pixel])
            return true;
        ray.nearest = hit.distance + kOffOpening;
    }
    return true;
}

} // namespace relamp
