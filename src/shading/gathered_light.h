#pragma once

#include "base/sparse_blocks.h"
#include "shading/lamp_patches.h"
#include "shading/texel_shading.h"
#include "shading/visibility.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relamp
{

/// What a surfel's middle gets of a lamp at radiance 1.
struct LampOnSurfel
{
    float visible = 0.0f;   // irradiance
    float deviation = 0.0f; // standard, of irradiance over the surfels around, as far as they see
                            // other shares of it

    bool operator==(const LampOnSurfel&) const = default;
};
using LampOnSurfels = SparseBlocks<LampOnSurfel>;

/// What is fixed of the lamps of a room once rays are cast, whatever their power.
struct CastLamps
{
    std::vector<LampPatches> patches;
    Visibility visibility;                // of the same lamps
    std::vector<LampOnSurfels> onSurfels; // likewise

    CastLamps(std::vector<LampPatches> lamps, Visibility seen, const Surfels& surfels);
    [[nodiscard]] size_t count() const { return patches.size(); }
};

/// Everything that the default solver knows of the light of a room.
struct GatheredLight
{
    std::shared_ptr<const CastLamps> lamps;
    std::vector<glm::vec3> radiance; // of each
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
