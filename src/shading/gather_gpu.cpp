#include "shading/gather_gpu.h"

#include "shading/gather.comp.h"
#include "shading/gather.gpu.h"
#include "shading/gather_settling.comp.h"

namespace relamp
{
namespace
{

std::vector<uint32_t> targetsOf(const HitLists& hits, size_t surfels)
{
    std::vector<uint32_t> targets;
    targets.reserve(hits.targets.size());
    for (const HitTarget target : hits.targets) {
        if (target.isNothing()) {
            targets.push_back(static_cast<uint32_t>(3 * surfels + target.part()));
            continue;
        }
        const size_t part = target.side().isBack() ? 2 : target.isClipped() ? 1 : 0;
        targets.push_back(static_cast<uint32_t>(part * surfels + target.side().surfel()));
    }
    return targets;
}

} // namespace

GpuSightLists::GpuSightLists(const gpu::Device& device, const std::vector<uint32_t>& firsts,
                             const std::vector<uint32_t>& targets)
    : first(device, firsts), target(device, targets), count(firsts.size() - 1)
{}

GpuSightLists::GpuSightLists(const gpu::Device& device, const HitLists& hits, size_t surfels)
    : GpuSightLists(device, hits.firstTarget, targetsOf(hits, surfels))
{
    outside = static_cast<uint32_t>(3 * surfels);
}

GpuSightLists GpuSightLists::othersOf(const gpu::Device& device, const HitLists& hits,
                                      size_t surfels)
{
    const std::vector<uint32_t> all = targetsOf(hits, surfels);
    std::vector<uint32_t> firsts{0};
    std::vector<uint32_t> others;
    for (size_t list = 0; list < hits.sideOfList.size(); ++list) {
        for (uint32_t i = hits.firstTarget[list]; i < hits.firstTarget[list + 1]; ++i)
            if (all[i] >= surfels) others.push_back(all[i]);
        firsts.push_back(static_cast<uint32_t>(others.size()));
    }
    return {device, firsts, others};
}

std::vector<glm::uvec2> fieldOnGpu(const RadianceField& field)
{
    std::vector<glm::uvec2> entries;
    entries.reserve(3 * field.plain.size() + HitTarget::kMostParts);
    const auto add = [&](glm::vec3 radiance) {
        entries.push_back(packedHalves(glm::vec4(radiance, 0.0f)));
    };
    for (const glm::vec3 radiance : field.plain) add(radiance);
    for (size_t s = 0; s < field.clipped.size(); ++s)
        add(field.shines[s] != 0 ? glm::vec3(0.0f) : field.clipped[s]);
    for (const glm::vec3 radiance : field.back) add(radiance);
    for (size_t part = 0; part < HitTarget::kMostParts; ++part) add(field.outside[part]);
    return entries;
}

GatherGpu::GatherGpu(const gpu::Device& device) : program_(device, kGatherSpirv) {}

void GatherGpu::gather(gpu::Commands& commands, const GpuSightLists& lists,
                       const gpu::Array<glm::uvec2>& radiance, const GpuGathered& gathered,
                       size_t count, size_t step) const
{
    commands.dispatch(program_, count,
                      GatherArguments{lists.first.ref(), lists.target.ref(), radiance.ref(),
                                      gathered.irradiance.ref(), gathered.missed.ref(),
                                      lists.outside, static_cast<uint32_t>(step),
                                      static_cast<uint32_t>(count)});
    commands.barrier();
}

SettlingGatherGpu::SettlingGatherGpu(const gpu::Device& device, const HitLists& hits,
                                     const GpuSightLists& lists, const GatherGpu& gather,
                                     const gpu::Array<glm::uvec2>& plain)
    : program_(device, kGatherSettlingSpirv), lists_(lists), plain_(device, lists.count),
      others_(GpuSightLists::othersOf(device, hits, (plain.count() - HitTarget::kMostParts) / 3))
{
    gpu::Commands commands(device);
    gather.gather(commands, lists, plain, plain_, lists.count);
    commands.run();
}

void SettlingGatherGpu::gather(gpu::Commands& commands, const gpu::Array<glm::uvec2>& radiance,
                               const gpu::Array<glm::vec4>& irradiance) const
{
    commands.dispatch(program_, lists_.count,
                      SettlingArguments{.first = lists_.first.ref(),
                                        .plain = plain_.irradiance.ref(),
                                        .firstOther = others_.first.ref(),
                                        .other = others_.target.ref(),
                                        .radiance = radiance.ref(),
                                        .irradiance = irradiance.ref(),
                                        .count = static_cast<uint32_t>(lists_.count)});
    commands.barrier();
}

} // namespace relamp
