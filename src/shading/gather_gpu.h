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
    static constexpr uint32_t kNone = ~0u;

    GpuSightLists(const gpu::Device& device, const std::vector<uint32_t>& firsts,
                  const std::vector<uint32_t>& targets);
    /// The targets are indices of a fieldOnGpu().
    GpuSightLists(const gpu::Device& device, const HitLists& hits, size_t surfels);
    /// Those of these targets that are no plain fronts.
    static GpuSightLists othersOf(const gpu::Device& device, const HitLists& hits, size_t surfels);

    gpu::Array<uint32_t> first; // of lists, and one more
    gpu::Array<uint32_t> target;
    size_t count;             // of lists
    uint32_t outside = kNone; // the targets from here on are outside
};

/// A field as halves: `plain` of all surfels, then `clipped`, 0 where they shine, then `back`; then
/// `outside`, HitTarget::kMostParts of it.
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

/// Gathers a field again and again while its light settles, without noise. Plain fronts stay as
/// they are, so they are summed once; of the others there are few.
class SettlingGatherGpu
{
public:
    /// `lists` are those of `hits`, `plain` is the first field with nothing in it but plain fronts.
    /// The device and `lists` must outlive this.
    SettlingGatherGpu(const gpu::Device& device, const HitLists& hits, const GpuSightLists& lists,
                      const GatherGpu& gather, const gpu::Array<glm::uvec2>& plain);

    void gather(gpu::Commands& commands, const gpu::Array<glm::uvec2>& radiance,
                const gpu::Array<glm::vec4>& irradiance) const;
    /// Of directions that meet nothing, one a list.
    [[nodiscard]] const gpu::Array<float>& missed() const { return plain_.missed; }

private:
    gpu::Program program_;
    const GpuSightLists& lists_;
    GpuGathered plain_;
    GpuSightLists others_;
};

} // namespace relamp
