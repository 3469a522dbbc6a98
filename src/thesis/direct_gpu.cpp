#include "thesis/direct_gpu.h"

#include "thesis/direct.comp.h"
#include "thesis/direct.gpu.h"

namespace relamp
{

std::vector<glm::vec4> lightEntries(std::span<const PointLight> lights)
{
    std::vector<glm::vec4> entries;
    for (const PointLight& light : lights) {
        entries.emplace_back(light.position, 0.0f);
        entries.emplace_back(light.intensity, 0.0f);
    }
    return entries;
}

DirectGpu::DirectGpu(const gpu::Device& device)
    : device_(device), program_(device, kDirectSpirv), lights_(device, 0)
{}

void DirectGpu::setLights(std::span<const PointLight> lights)
{
    lights_ = gpu::Array<glm::vec4>(device_, lightEntries(lights));
}

void DirectGpu::shade(gpu::Commands& commands, const GpuTexels& page, glm::vec3 attenuation,
                      const gpu::Array<glm::uvec2>& irradiance) const
{
    commands.dispatch(program_, page.count,
                      DirectArguments{page.site.ref(), lights_.ref(), irradiance.ref(), attenuation,
                                      static_cast<uint32_t>(lights_.count() / 2),
                                      static_cast<uint32_t>(page.count)});
    commands.barrier();
}

} // namespace relamp
