#pragma once

#include "base/instruction_set.h"
#include "scan/texels.h"
#include "shading/texel_shading.h"

#include <cstdint>

namespace relamp
{

/// Divides the light out of a block of texels: albedo = radiance / (direct + indirect).
///
/// A shading below `darkest` is believed the less the darker it is (divide.shared.h). Where albedo
/// would be above 0.87, the shading is raised by `lack`, which makes it that: no paper is whiter.
/// Half floats; entries behind the block's last texel are unspecified.
struct AlbedoBlock
{
    alignas(64) uint16_t r[TexelBlock::kCapacity];
    alignas(64) uint16_t g[TexelBlock::kCapacity];
    alignas(64) uint16_t b[TexelBlock::kCapacity];
    alignas(64) float lack[TexelBlock::kCapacity]; // times the shading, >= 1
};
void divide(const TexelBlock& block, const ShadingBlock& shading, float darkest,
            AlbedoBlock& albedo, InstructionSet set = bestInstructionSet());

} // namespace relamp
