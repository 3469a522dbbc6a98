#include "thesis/flatten_gpu.h"

#include "thesis/flatten.comp.h"
#include "thesis/flatten.gpu.h"
#include "thesis/flatten.shared.h"
#include "thesis/flatten_finish.comp.h"
#include "thesis/flatten_gather.comp.h"

namespace relamp
{

FlattenGpu::FlattenGpu(const gpu::Device& device, size_t surfels)
    : gather_(device, kFlattenGatherSpirv), finish_(device, kFlattenFinishSpirv),
      filter_(device, kFlattenSpirv), surfels_(surfels), cells_(device, kFlattenBins * surfels)
{}

void FlattenGpu::begin(gpu::Commands& commands) const
{
    commands.clear(cells_.buffer());
    commands.barrier();
}

void FlattenGpu::gather(gpu::Commands& commands, const GpuTexels& page) const
{
    commands.dispatch(gather_, page.runCount,
                      FlattenGatherArguments{page.radiance.ref(), page.runs.ref(), cells_.ref(),
                                             static_cast<uint32_t>(page.runCount)});
    commands.barrier(); // pages share surfels
}

void FlattenGpu::finish(gpu::Commands& commands) const
{
    commands.dispatch(finish_, surfels_,
                      FlattenFinishArguments{cells_.ref(), static_cast<uint32_t>(surfels_)});
    commands.barrier();
}

void FlattenGpu::filter(gpu::Commands& commands, const GpuTexels& page, const GpuSurfels& surfels,
                        const FlattenOptions& options, const gpu::Array<uint32_t>& flattened) const
{
    const float reach = options.reach * surfels.size;
    commands.dispatch(filter_, page.count,
                      FlattenArguments{.site = page.site.ref(),
                                       .radiance = page.radiance.ref(),
                                       .surfel = page.surfel.ref(),
                                       .pixel = page.pixel.ref(),
                                       .cells = cells_.ref(),
                                       .position = surfels.position.ref(),
                                       .normal = surfels.normal.ref(),
                                       .firstNeighbor = surfels.firstNeighbor.ref(),
                                       .neighbor = surfels.neighbor.ref(),
                                       .flattened = flattened.ref(),
                                       .perReachSquared = 1.0f / (reach * reach),
                                       .perRangeSquared = 1.0f / (options.range * options.range),
                                       .count = static_cast<uint32_t>(page.count)});
    commands.barrier();
}

} // namespace relamp
