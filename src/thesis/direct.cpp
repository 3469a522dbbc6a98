#include "thesis/direct.h"

#include "base/lanes.h"
#include "thesis/direct.shared.h"

namespace relamp
{
namespace
{

void directKernel(const TexelBlock& block, const LightArrays& lights, const glm::vec3& k,
                  RgbBlock& out)
{
    const size_t lightCount = lights.count();
    for (size_t first = 0; first < block.count; first += kLanes) {
        float r[kLanes] = {};
        float g[kLanes] = {};
        float b[kLanes] = {};
        for (size_t j = 0; j < lightCount; ++j) {
            const glm::vec3 light(lights.x[j], lights.y[j], lights.z[j]);
            for (size_t lane = 0; lane < kLanes; ++lane) {
                const size_t i = first + lane;
                const glm::vec3 toLight = light - glm::vec3(block.x[i], block.y[i], block.z[i]);
                const glm::vec3 normal(block.nx[i], block.ny[i], block.nz[i]);
                const float received = receivedFrom(toLight, normal, k);
                r[lane] += received * lights.r[j];
                g[lane] += received * lights.g[j];
                b[lane] += received * lights.b[j];
            }
        }
        for (size_t lane = 0; lane < kLanes; ++lane) {
            out.r[first + lane] = r[lane];
            out.g[first + lane] = g[lane];
            out.b[first + lane] = b[lane];
        }
    }
}

} // namespace

LightArrays::LightArrays(std::span<const PointLight> lights)
{
    for (const PointLight& light : lights) {
        x.push_back(light.position.x);
        y.push_back(light.position.y);
        z.push_back(light.position.z);
        r.push_back(light.intensity.r);
        g.push_back(light.intensity.g);
        b.push_back(light.intensity.b);
    }
}

void directIrradiance(const TexelBlock& block, const LightArrays& lights, glm::vec3 attenuation,
                      RgbBlock& irradiance, InstructionSet set)
{
    runKernel<directKernel>(set, block, lights, attenuation, irradiance);
}

} // namespace relamp
