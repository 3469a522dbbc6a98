#include "thesis/rsm_gpu.h"

#include "thesis/direct_gpu.h"
#include "thesis/rsm.comp.h"
#include "thesis/rsm.h"
#include "thesis/rsm_color.comp.h"

#include <algorithm>

namespace relamp
{
namespace
{

constexpr float kSphere = 12.5663706f; // sr

} // namespace

RsmGpu::RsmGpu(const gpu::Device& device)
    : device_(device), trace_(device, kRsmSpirv), color_(device, kRsmColorSpirv), views_(device, 0),
      pixels_(device, 0), leaving_(device, 0)
{}

void RsmGpu::setLights(std::span<const PointLight> lights, int resolution)
{
    resolution_ = static_cast<uint32_t>(resolution);
    std::vector<PointLight> views(lights.begin(), lights.end());
    glm::vec3 flux(0.0f);
    for (PointLight& view : views) {
        view.position = viewpointOf(view);
        flux += kSphere * view.intensity;
    }
    mostFlux_ = std::max({flux.r, flux.g, flux.b});
    views_ = gpu::Array<glm::vec4>(device_, lightEntries(views));
    const size_t count = 6 * views.size() * resolution_ * resolution_;
    if (count == pixels_.count()) return;
    pixels_ = gpu::Array<RsmPixel>(device_, count);
    leaving_ = gpu::Array<glm::vec4>(device_, count);
}

void RsmGpu::trace(gpu::Commands& commands, const GpuSurface& surface) const
{
    commands.dispatch(trace_, pixels_.count(),
                      RsmArguments{surface.nodes.ref(), surface.boxedTriangles.ref(),
                                   surface.triangles.ref(), surface.meshes.ref(), views_.ref(),
                                   pixels_.ref(), resolution_,
                                   static_cast<uint32_t>(pixels_.count())});
    commands.barrier();
}

void RsmGpu::color(gpu::Commands& commands, uint32_t page,
                   const gpu::Array<uint32_t>& flattened) const
{
    commands.dispatch(color_, pixels_.count(),
                      RsmColorArguments{pixels_.ref(), flattened.ref(), leaving_.ref(), page,
                                        static_cast<uint32_t>(pixels_.count())});
    commands.barrier();
}

} // namespace relamp
