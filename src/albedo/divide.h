#pragma once

#include "base/instruction_set.h"
#include "scan/texels.h"
#include "shading/thesis.h"

#include <cstdint>

namespace relamp
{

/// Divides the light out of a block of texels: albedo = radiance / (direct + indirect).
///
/// The shading is raised to `darkest` first. Half floats; entries behind the block's last texel are
/// unspecified.
struct AlbedoBlock
{
    alignas(64) uint16_t r[TexelBlock::kCapacity];
    alignas(64) uint16_t g[TexelBlock::kCapacity];
    alignas(64) uint16_t b[TexelBlock::kCapacity];
};
void divide(const TexelBlock& block, const ShadingBlock& shading, float darkest,
            AlbedoBlock& albedo, InstructionSet set = bestInstructionSet());

} // namespace relamp
