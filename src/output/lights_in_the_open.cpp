#include "output/lights_in_the_open.h"

namespace relamp
{
namespace
{

constexpr float kDeepest = 0.15f; // m; of a lamp's middle behind its own surface
constexpr float kAhead = 0.02f;   // m; before the last surface of it
constexpr int kMostSurfaces = 8;  // on the way out

} // namespace

std::vector<PointLight> inTheOpen(std::vector<PointLight> lights, const RayScene& scene)
{
    for (PointLight& light : lights) {
        if (light.normal == glm::vec3(0.0f)) continue;
        for (int i = 0; i < kMostSurfaces; ++i) {
            const Hit hit = scene.intersect(
                {.origin = light.position, .direction = light.normal, .farthest = kDeepest});
            if (hit.missed()) break;
            light.position += (hit.distance + kAhead) * light.normal;
        }
    }
    return lights;
}

} // namespace relamp
