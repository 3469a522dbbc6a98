#pragma once

#include "gpu/commands.h"
#include "shading/gather.h"

#include <span>
#include <vector>

namespace relamp
{

/// What rays met, list by list, as indices of radiances.
struct GpuSightLists
{
    static constexpr uint32_t kNothing = ~0u; // the target that is no radiance

    GpuSightLists(const gpu::Device& device, const std::vector<uint32_t>& firsts,
                  const std::vector<uint32_t>& targets);
    /// The targets are indices of a fieldOnGpu().
    GpuSightLists(const gpu::Device& device, const HitLists& hits, size_t surfels);

    gpu::Array<uint32_t> first; // of lists, and one more
    gpu::Array<uint32_t> target;
    size_t count; // of lists
};

/// A field as halves: `plain` of all surfels, then `clipped`, 0 where they shine, then `back`.
std::vector<glm::uvec2> fieldOnGpu(const RadianceField& field);

/// Light that arrives, one entry a list, as Gathered.
struct GpuGathered
{
    GpuGathered(const gpu::Device& device, size_t lists)
        : irradiance(device, lists), missed(device, lists)
    {}

    gpu::Array<glm::vec4> irradiance; // w: noise
    gpu::Array<float> missed;
};

/// gather() on a GPU.
class GatherGpu
{
public:
    explicit GatherGpu(const gpu::Device& device);

    /// By every `step`-th ray of the first `count` lists.
    void gather(gpu::Commands& commands, const GpuSightLists& lists,
                const gpu::Array<glm::uvec2>& radiance, const GpuGathered& gathered, size_t count,
                size_t step = 1) const;

private:
    gpu::Program program_;
};

} // namespace relamp
