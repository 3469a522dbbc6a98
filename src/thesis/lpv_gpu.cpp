#include "thesis/lpv_gpu.h"

#include "thesis/lpv.comp.h"
#include "thesis/lpv.gpu.h"
#include "thesis/lpv_block.comp.h"
#include "thesis/lpv_cover.comp.h"
#include "thesis/lpv_inject.comp.h"
#include "thesis/lpv_read_out.comp.h"
#include "thesis/lpv_start.comp.h"

namespace relamp
{
namespace
{

/// Whole numbers that all flux together may come to in one coefficient: a lobe's is 1.02 / pi of
/// it.
constexpr float kMostUnits = 2e9f;

LpvCells cellsOf(const LpvGrid& grid)
{
    return {grid.cells, grid.origin, grid.cell};
}

} // namespace

LpvGpu::Volume::Volume(const gpu::Device& device, const LpvGrid& ofGrid)
    : grid(ofGrid), corners(device, 4 * grid.count()), coverage(device, 3 * grid.count()),
      injected(device, 12 * grid.count()), travelling(device, 3 * grid.count()),
      arriving(device, 3 * grid.count()), accumulated(device, 3 * grid.count())
{}

LpvGpu::LpvGpu(const gpu::Device& device)
    : device_(device), block_(device, kLpvBlockSpirv), cover_(device, kLpvCoverSpirv),
      inject_(device, kLpvInjectSpirv), start_(device, kLpvStartSpirv),
      propagate_(device, kLpvSpirv), readOut_(device, kLpvReadOutSpirv)
{}

void LpvGpu::setGrid(const LpvGrid& grid)
{
    volume_.reset();
    volume_.emplace(device_, grid);
}

void LpvGpu::block(gpu::Commands& commands, const GpuSurfels& surfels) const
{
    const Volume& v = *volume_;
    commands.clear(v.corners.buffer());
    commands.barrier();
    commands.dispatch(block_, surfels.count,
                      LpvBlockArguments{surfels.position.ref(), surfels.normal.ref(),
                                        v.corners.ref(), cellsOf(v.grid),
                                        static_cast<uint32_t>(surfels.count)});
    commands.barrier();
    commands.dispatch(cover_, v.grid.count(),
                      LpvCoverArguments{v.corners.ref(), v.coverage.ref(), v.grid.cells,
                                        static_cast<uint32_t>(v.grid.count())});
    commands.barrier();
}

void LpvGpu::spread(gpu::Commands& commands, const RsmGpu& maps, int steps) const
{
    const Volume& v = *volume_;
    const float unitsPerFlux = maps.mostFlux() > 0.0f ? kMostUnits / maps.mostFlux() : 1.0f;
    const auto channels = static_cast<uint32_t>(3 * v.grid.count());
    commands.clear(v.injected.buffer());
    commands.clear(v.arriving.buffer()); // its border stays 0
    commands.barrier();
    commands.dispatch(inject_, maps.pixels().count(),
                      LpvInjectArguments{maps.pixels().ref(), maps.leaving().ref(),
                                         v.injected.ref(), cellsOf(v.grid), unitsPerFlux,
                                         static_cast<uint32_t>(maps.pixels().count())});
    commands.barrier();
    commands.dispatch(start_, channels,
                      LpvStartArguments{v.injected.ref(), v.travelling.ref(), v.accumulated.ref(),
                                        1.0f / unitsPerFlux, channels});
    for (int step = 0; step < steps; ++step) {
        commands.barrier();
        const auto& from = step % 2 == 0 ? v.travelling : v.arriving;
        const auto& to = step % 2 == 0 ? v.arriving : v.travelling;
        commands.dispatch(propagate_, channels,
                          LpvArguments{from.ref(), to.ref(), v.accumulated.ref(), v.coverage.ref(),
                                       v.grid.cells, step == 0 ? 0u : 1u, channels});
    }
    commands.barrier();
}

void LpvGpu::readOut(gpu::Commands& commands, const GpuTexels& page,
                     const gpu::Array<glm::uvec2>& irradiance) const
{
    const Volume& v = *volume_;
    commands.dispatch(readOut_, page.count,
                      LpvReadOutArguments{page.site.ref(), v.accumulated.ref(), irradiance.ref(),
                                          cellsOf(v.grid), static_cast<uint32_t>(page.count)});
    commands.barrier();
}

Lpv::Field LpvGpu::accumulated() const
{
    const std::vector<glm::vec4> entries = volume_->accumulated.download();
    Lpv::Field field;
    for (size_t c = 0; c < 3; ++c)
        for (size_t k = 0; k < 4; ++k) {
            field[c][k].resize(volume_->grid.count());
            for (size_t i = 0; i < field[c][k].size(); ++i)
                field[c][k][i] = entries[3 * i + c][static_cast<int>(k)];
        }
    return field;
}

} // namespace relamp
