#pragma once

#include "shading/lamp_patches.h"
#include "shading/texel_shading.h"
#include "shading/visibility.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relamp
{

/// A lamp with a power.
struct LitLamp
{
    LampPatches patches;
    glm::vec3 radiance{0.0f};
};

/// Everything that the default solver knows of the light of a room.
struct GatheredLight
{
    std::vector<LitLamp> lamps;
    std::shared_ptr<const Visibility> visibility; // of the same lamps
    std::vector<glm::vec3> indirect; // irradiance at surfels' fronts that did not come from a lamp
};

/// Shading of texels [begin, begin + block.count) of a page, interpolated between what the surfels
/// of one surface receive: `irradiance`, one a surfel.
void interpolate(const Texels& texels, std::span<const glm::vec3> irradiance, size_t page,
                 size_t begin, const TexelBlock& block, RgbBlock& out);

/// Shades texels: indirect light interpolated between surfels of one surface, direct light of every
/// lamp by its area, as much of it as can be seen.
TexelShading shadingOf(const Texels& texels, std::shared_ptr<const GatheredLight> light);

/// The light that arrives in the middle of each surfel.
struct SurfelLighting
{
    std::vector<glm::vec3> irradiance;
    std::vector<float> spread; // standard deviation of the luminance of lamps' light over the
                               // surfels around, as far as they see other shares of them
};
SurfelLighting lightOnSurfels(const Surfels& surfels, const GatheredLight& light);

} // namespace relamp
