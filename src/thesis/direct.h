#pragma once

#include "base/instruction_set.h"
#include "relamp/lights.h"
#include "scan/texels.h"

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Point lights as structure of arrays.
struct LightArrays
{
    LightArrays() = default;
    explicit LightArrays(std::span<const PointLight> lights);

    std::vector<float> x, y, z; // world position, m
    std::vector<float> r, g, b; // radiant intensity

    [[nodiscard]] size_t count() const { return x.size(); }
};

/// Irradiance from all lights at the texels of a block, without visibility.
///
/// `attenuation` is (k0, k1, k2) of Choi's 1 / (k0 + k1 d + k2 d^2), d in metres. Entries of
/// `irradiance` behind the block's last texel are unspecified.
void directIrradiance(const TexelBlock& block, const LightArrays& lights, glm::vec3 attenuation,
                      RgbBlock& irradiance, InstructionSet set = bestInstructionSet());

} // namespace relamp
