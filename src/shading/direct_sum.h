#pragma once

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "scan/texels.h"
#include "shading/lamp_sight.h"

#include <algorithm>
#include <span>

#include <glm/vec3.hpp>

namespace relamp
{

// Light at a place is E = sum of e D + sum of a M + K. This is its first sum for every kind of
// place: what a lamp brings there at radiance 1, D, times its radiance e. gather() is the rest.
// Its twin of a GPU is in lamp_terms.gpu.h.

/// Adds a lamp's light on places by what they see of it.
inline void addDirect(const LampSight& seen, glm::vec3 radiance, std::span<glm::vec3> irradiance)
{
    forEach(seen.blocks(), [&](size_t block) {
        seen.forEachOf(block, [&](size_t i, AreaSample sample) {
            irradiance[i] += sample.visible * radiance;
        });
    });
}

/// The same where nothing else is kept of that.
inline void addDirect(std::span<const float> visible, glm::vec3 radiance,
                      std::span<glm::vec3> irradiance)
{
    forEach(irradiance.size(), [&](size_t i) { irradiance[i] += visible[i] * radiance; });
}

/// A lamp on the texels of a block, which see a `share` of what would be there with nothing in the
/// way.
struct LampOnBlock
{
    float open[TexelBlock::kPadded];
    float share[TexelBlock::kPadded];
};

/// Adds its shading, irradiance / pi, of the first texels.
inline void addDirect(const LampOnBlock& on, glm::vec3 radiance, size_t texels, RgbBlock& shading)
{
    const glm::vec3 perIrradiance = radiance / kPi;
    for (size_t i = 0; i < texels; ++i) {
        shading.r[i] += on.open[i] * on.share[i] * perIrradiance.r;
        shading.g[i] += on.open[i] * on.share[i] * perIrradiance.g;
        shading.b[i] += on.open[i] * on.share[i] * perIrradiance.b;
    }
}

/// No light yet.
inline void darken(RgbBlock& shading, size_t texels)
{
    for (float* channel : {shading.r, shading.g, shading.b}) std::fill_n(channel, texels, 0.0f);
}

} // namespace relamp
