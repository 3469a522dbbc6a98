#pragma once

#include "gpu/commands.h"
#include "relamp/lights.h"
#include "scan/texels_gpu.h"
#include "thesis/rsm.gpu.h"

#include <span>

namespace relamp
{

/// reflectiveShadowMaps() on a GPU, by rays, and the light that their pixels pass on.
class RsmGpu
{
public:
    explicit RsmGpu(const gpu::Device& device);

    void setLights(std::span<const PointLight> lights, int resolution);
    void trace(gpu::Commands& commands, const GpuSurface& surface) const;
    /// Gives pixels on `page` its colour; after trace(), once a page.
    void color(gpu::Commands& commands, uint32_t page, const gpu::Array<uint32_t>& flattened) const;

    [[nodiscard]] const gpu::Array<RsmPixel>& pixels() const { return pixels_; }
    /// Flux that leaves the pixels.
    [[nodiscard]] const gpu::Array<glm::vec4>& leaving() const { return leaving_; }
    /// Flux of all lights, of the brightest channel: no less than what leaves all pixels.
    [[nodiscard]] float mostFlux() const { return mostFlux_; }

private:
    const gpu::Device& device_;
    gpu::Program trace_;
    gpu::Program color_;
    uint32_t resolution_ = 0;
    float mostFlux_ = 0.0f;
    gpu::Array<glm::vec4> views_;
    gpu::Array<RsmPixel> pixels_;
    gpu::Array<glm::vec4> leaving_;
};

} // namespace relamp
