#include "scan/one_room.h"

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr std::array kHeights{0.1f, 0.5f, 1.0f, 1.8f}; // m over surfaces
// Of a way, to its side from its middle: past furniture, and into the other arm of an L.
constexpr std::array kCorners{0.25f, -0.25f, 0.5f, -0.5f};
constexpr float kNoiseOfMesh = 0.02f; // m, that a place of a reconstruction may lie behind its mesh

bool isFree(const RayScene& scene, glm::vec3 from, glm::vec3 to, float nearest = 0.0f)
{
    const float way = glm::distance(from, to);
    return way <= nearest || !scene.occluded({from, (to - from) / way, nearest,
                                              way + kOffSurface}); // ends on nothing
}

/// Whether a way without a corner or with one leads from one to the other, beside `normal`. One
/// that leaves the scan's box leads out of a window and in by another.
bool isReachable(const RayScene& scene, glm::vec3 from, glm::vec3 to, glm::vec3 normal)
{
    const glm::vec3 aside = glm::cross(normal, to - from);
    return isFree(scene, from, to) ||
           std::any_of(kCorners.begin(), kCorners.end(), [&](float corner) {
               const glm::vec3 by = 0.5f * (from + to) + corner * aside;
               return scene.bounds().contains(by) && isFree(scene, from, by) &&
                      isFree(scene, by, to);
           });
}

/// Whether there is one over both at a height that `isReached(height)`.
template<class IsReached>
bool isWayOver(const RayScene& scene, const FacingPlace& p, const FacingPlace& q,
               const IsReached& isReached)
{
    return std::any_of(kHeights.begin(), kHeights.end(), [&](float height) {
        return isReached(height) && isReachable(scene, p.position + height * p.normal,
                                                q.position + height * q.normal, p.normal);
    });
}

} // namespace

bool areInOneRoomOfPlane(const RayScene& scene, const FacingPlace& p, const FacingPlace& q)
{
    return isWayOver(scene, p, q, [](float) { return true; });
}

bool areInOneRoom(const RayScene& scene, const FacingPlace& p, const FacingPlace& q)
{
    return isWayOver(scene, p, q, [&](float height) {
        const auto isOverIt = [&](const FacingPlace& place) {
            return isFree(scene, place.position, place.position + height * place.normal,
                          kNoiseOfMesh);
        };
        return isOverIt(p) && isOverIt(q);
    });
}

} // namespace relamp
