#pragma once

#include "gpu/commands.h"
#include "scan/texels_gpu.h"
#include "thesis/lpv.h"
#include "thesis/rsm_gpu.h"

#include <optional>

namespace relamp
{

/// A light propagation volume on a GPU; see Lpv.
class LpvGpu
{
public:
    explicit LpvGpu(const gpu::Device& device);

    /// Makes room for a grid; what was there is gone.
    void setGrid(const LpvGrid& grid);
    [[nodiscard]] bool hasGrid() const { return volume_.has_value(); }
    /// Fills the geometry volume.
    void block(gpu::Commands& commands, const GpuSurfels& surfels) const;
    /// Injects what leaves the pixels of shadow maps and takes it `steps` steps on.
    void spread(gpu::Commands& commands, const RsmGpu& maps, int steps) const;
    /// `irradiance` is of the page's texels: RGB as halves.
    void readOut(gpu::Commands& commands, const GpuTexels& page,
                 const gpu::Array<glm::uvec2>& irradiance) const;

    /// What has accumulated, for the CPU to read out.
    [[nodiscard]] Lpv::Field accumulated() const;

private:
    /// Three entries a cell, the channels', four coefficients each.
    struct Volume
    {
        Volume(const gpu::Device& device, const LpvGrid& ofGrid);

        LpvGrid grid;
        gpu::Array<int32_t> corners;
        gpu::Array<glm::vec4> coverage; // of the faces towards the next cells
        gpu::Array<int32_t> injected;
        gpu::Array<glm::vec4> travelling;
        gpu::Array<glm::vec4> arriving;
        gpu::Array<glm::vec4> accumulated;
    };

    const gpu::Device& device_;
    gpu::Program block_;
    gpu::Program cover_;
    gpu::Program inject_;
    gpu::Program start_;
    gpu::Program propagate_;
    gpu::Program readOut_;
    std::optional<Volume> volume_;
};

} // namespace relamp
