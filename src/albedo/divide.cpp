#include "albedo/divide.h"

#include "albedo/divide.shared.h"
#include "base/half.h"

namespace relamp
{
namespace
{

void divideKernel(const TexelBlock& block, const ShadingBlock& shading, const float& darkest,
                  AlbedoBlock& albedo)
{
    for (size_t i = 0; i < block.count; ++i) {
        const glm::vec3 radiance(block.r[i], block.g[i], block.b[i]);
        const glm::vec3 direct(shading.direct.r[i], shading.direct.g[i], shading.direct.b[i]);
        const glm::vec3 indirect(shading.indirect.r[i], shading.indirect.g[i],
                                 shading.indirect.b[i]);
        const glm::vec3 rho = dividedByShading(radiance, direct + indirect, darkest);
        const float lack = lightThatLacks(rho);
        albedo.r[i] = halfFromFloat(rho.r / lack);
        albedo.g[i] = halfFromFloat(rho.g / lack);
        albedo.b[i] = halfFromFloat(rho.b / lack);
        albedo.lack[i] = lack;
    }
}

} // namespace

void divide(const TexelBlock& block, const ShadingBlock& shading, float darkest,
            AlbedoBlock& albedo, InstructionSet set)
{
    runKernel<divideKernel>(set, block, shading, darkest, albedo);
}

} // namespace relamp
