#pragma once

#include "gpu/commands.h"
#include "scan/texels_gpu.h"
#include "thesis/flatten.h"

namespace relamp
{

/// flatten() on a GPU: gather() every page, finish(), then filter() every page.
class FlattenGpu
{
public:
    FlattenGpu(const gpu::Device& device, size_t surfels);

    void begin(gpu::Commands& commands) const;
    void gather(gpu::Commands& commands, const GpuTexels& page) const;
    void finish(gpu::Commands& commands) const;
    /// `flattened` is the page's: square roots of radiance as bytes, four a pixel, where a texel
    /// is.
    void filter(gpu::Commands& commands, const GpuTexels& page, const GpuSurfels& surfels,
                const FlattenOptions& options, const gpu::Array<uint32_t>& flattened) const;

private:
    gpu::Program gather_;
    gpu::Program finish_;
    gpu::Program filter_;
    size_t surfels_;
    gpu::Array<glm::vec4> cells_;
};

} // namespace relamp
