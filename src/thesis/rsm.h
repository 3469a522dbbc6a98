#pragma once

#include "relamp/lights.h"
#include "scan/rays.h"
#include "scan/texels.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// A piece of surface that light falls on: one pixel of a reflective shadow map.
struct BounceLight
{
    glm::vec3 position{0.0f}; // world, m
    glm::vec3 normal{0.0f};   // unit
    glm::vec3 flux{0.0f}; // RGB, radiance * m^2 * sr; arriving until it is multiplied by an albedo
    uint32_t page = 0;    // where the surface has its colour
    uint32_t pixel = 0;
};

/// Where the view of a light begins: a light found on a scan lies within the noise of its surface.
glm::vec3 viewpointOf(const PointLight& light);

/// Reflective shadow maps (Dachsbacher & Stamminger 2005): what each light's own view of the room
/// receives. A view is a cube of six faces of `resolution` squared pixels; a pixel's flux is the
/// intensity times its solid angle, so the sum over a room does not depend on how many there are.
/// Surfaces met from behind and rays that leave the room receive nothing. The result is in the
/// order of lights, faces and pixels.
std::vector<BounceLight> reflectiveShadowMaps(const Texels& texels, const RayScene& scene,
                                              std::span<const PointLight> lights, int resolution);

} // namespace relamp
