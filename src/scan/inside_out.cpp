#include "scan/inside_out.h"

#include "base/sampling.shared.h"

#include <algorithm>

namespace relamp
{
namespace
{

// Numerics.
constexpr size_t kLooks = 2000; // from surfels, evenly along their curve through space
constexpr size_t kFewest = 50;  // that tell anything

/// A ray from one side of a surfel.
Ray lookFrom(const Surfels& surfels, uint32_t surfel, float side)
{
    const glm::vec3 normal = side * surfels.normal[surfel];
    const glm::vec2 u(hashedShift(surfel, 1), hashedShift(surfel, 2));
    return {surfels.position[surfel] + kOffSurface * normal, cosineDirection(normal, u)};
}

} // namespace

bool isInsideOut(const Surfels& surfels, const RayScene& scene)
{
    const size_t looks = std::min(kLooks, surfels.count());
    std::vector<Ray> rays;
    for (const float side : {1.0f, -1.0f})
        for (size_t k = 0; k < looks; ++k)
            rays.push_back(
                lookFrom(surfels, static_cast<uint32_t>(k * surfels.count() / looks), side));
    std::vector<Hit> hits(rays.size());
    scene.intersect(rays, hits, RayOrder::scattered);
    const auto seen = [&](size_t first, bool front) {
        return std::count_if(hits.begin() + static_cast<ptrdiff_t>(first),
                             hits.begin() + static_cast<ptrdiff_t>(first + looks),
                             [&](const Hit& hit) { return !hit.missed() && hit.front == front; });
    };
    const auto frontsByFronts = static_cast<size_t>(seen(0, true));
    const auto backsByBacks = static_cast<size_t>(seen(looks, false));
    return looks >= kFewest && 2 * backsByBacks > looks && 2 * backsByBacks > 3 * frontsByFronts;
}

std::optional<std::string> noteOnFacing(const Surfels& surfels, const RayScene& scene)
{
    if (!isInsideOut(surfels, scene)) return std::nullopt;
    return "its surfaces face outwards, away from what they enclose, so their light cannot be "
           "told. "
           "If it is a room, turn its triangles round (in Blender: Mesh > Normals > Flip) and take "
           "that file";
}

} // namespace relamp
