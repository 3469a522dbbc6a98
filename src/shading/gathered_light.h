#pragma once

#include "shading/lit_sides.h"
#include "shading/texel_shading.h"

#include <memory>
#include <vector>

namespace relamp
{

/// A lamp with a power.
struct LitLamp
{
    AreaLight light;
    glm::vec3 radiance{0.0f};
};

/// Everything that the default solver knows of the light of a room.
struct GatheredLight
{
    std::vector<LitLamp> lamps;
    std::vector<glm::vec3> indirect; // irradiance at surfels' fronts that did not come from a lamp
};

struct GatheredLightOptions
{
    size_t shadowSamples = 16; // points of a lamp that a texel looks for, >= 1
};

/// Shades texels: indirect light interpolated between surfels of one surface, direct light of every
/// lamp by area with shadow rays from every texel.
TexelShading shadingOf(const Texels& texels, const RayScene& scene,
                       std::shared_ptr<const GatheredLight> light,
                       const GatheredLightOptions& options);

} // namespace relamp
