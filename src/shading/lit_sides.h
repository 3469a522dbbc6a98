#pragma once

#include "scan/rays.h"
#include "shading/area_direct.h"
#include "shading/gather.h"
#include "shading/hit_lists.h"

#include <span>
#include <vector>

namespace relamp
{

/// A lamp with a power.
struct LitLamp
{
    AreaLight light;
    glm::vec3 radiance{0.0f};
};

/// Light at every side of every surfel.
struct LitSides
{
    RadianceField field;
    std::vector<glm::vec3> direct; // irradiance from lamps, one a list
    Gathered gathered;             // one a list
    std::vector<glm::vec3> albedo; // of surfels, 0..0.95
};

/// Irradiance from one lamp at radiance 1 on the sides that `lists` name; all where empty.
std::vector<float> directOfLists(const Texels& texels, const RayScene& scene, const HitLists& hits,
                                 const AreaLight& light, std::span<const uint32_t> lists = {});

/// Settles what the texture does not show: burnt-out walls send out albedo * irradiance / pi and
/// not the white that they show, backs are lit by what is behind them. `shines` marks the lamps'
/// surfels.
LitSides lightSides(const Texels& texels, const RayScene& scene, const HitLists& hits,
                    const SurfelRadiance& radiance, std::span<const LitLamp> lamps,
                    std::span<const uint8_t> shines, glm::vec3 ambient);

} // namespace relamp
