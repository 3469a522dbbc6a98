#include "scan/one_room.h"

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr std::array kHeights{0.1f, 0.5f, 1.0f}; // m over surfaces
constexpr float kNoiseOfMesh = 0.02f; // m, that a place of a reconstruction may lie behind its mesh

bool isFree(const RayScene& scene, glm::vec3 from, glm::vec3 to, float nearest = 0.0f)
{
    const float way = glm::distance(from, to);
    return way <= nearest || !scene.occluded({from, (to - from) / way, nearest, way});
}

} // namespace

bool areInOneRoom(const RayScene& scene, const FacingPlace& p, const FacingPlace& q)
{
    return std::any_of(kHeights.begin(), kHeights.end(), [&](float height) {
        const glm::vec3 overP = p.position + height * p.normal;
        const glm::vec3 overQ = q.position + height * q.normal;
        return isFree(scene, overP, overQ) && isFree(scene, p.position, overP, kNoiseOfMesh) &&
               isFree(scene, q.position, overQ, kNoiseOfMesh);
    });
}

} // namespace relamp
