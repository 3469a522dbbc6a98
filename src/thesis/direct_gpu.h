#pragma once

#include "gpu/commands.h"
#include "relamp/lights.h"
#include "scan/texels_gpu.h"

#include <span>

namespace relamp
{

/// Positions, then intensities, as programs read them: two entries a light.
std::vector<glm::vec4> lightEntries(std::span<const PointLight> lights);

/// directIrradiance() on a GPU.
class DirectGpu
{
public:
    explicit DirectGpu(const gpu::Device& device);

    void setLights(std::span<const PointLight> lights);
    /// `irradiance` is of the page's texels: RGB as halves.
    void shade(gpu::Commands& commands, const GpuTexels& page, glm::vec3 attenuation,
               const gpu::Array<glm::uvec2>& irradiance) const;

private:
    const gpu::Device& device_;
    gpu::Program program_;
    gpu::Array<glm::vec4> lights_;
};

} // namespace relamp
