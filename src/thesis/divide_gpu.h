#pragma once

#include "gpu/commands.h"
#include "image/padding_gpu.h"
#include "scan/texels_gpu.h"

namespace relamp
{

/// divide() on a GPU, with the parameters that turn irradiance into shading.
class DivideGpu
{
public:
    struct Parameters
    {
        float power;
        glm::vec3 ambient;
        float darkest; // as AlbedoOptions
    };

    explicit DivideGpu(const gpu::Device& device);

    /// `direct` and `indirect` are irradiance on the page's texels.
    void divide(gpu::Commands& commands, const GpuTexels& page,
                const gpu::Array<glm::uvec2>& direct, const gpu::Array<glm::uvec2>& indirect,
                const Parameters& parameters, const GpuPicture& albedo) const;

private:
    gpu::Program program_;
};

} // namespace relamp
