#include "solve/resolve_engine.h"

#include <algorithm>
#include <utility>

namespace relamp
{
namespace
{

void toShading(RgbBlock& block, size_t count)
{
    constexpr float kPerPi = 1.0f / 3.14159265f;
    for (float* channel : {block.r, block.g, block.b})
        std::transform(channel, channel + count, channel, [](float e) { return kPerPi * e; });
}

SettledLight settledBy(const ResolveGpu& gpu)
{
    SettledLight light;
    for (const glm::vec4 irradiance : gpu.gathered()) light.gathered.emplace_back(irradiance);
    for (const glm::vec4 irradiance : gpu.indirectOnSurfels())
        light.indirect.emplace_back(irradiance);
    return light;
}

} // namespace

ResolveEngine::ResolveEngine(const Texels& texels, const EngineOptions& options)
    : texels_(texels), gpu_(gpu::Choice::of(options), [this](const gpu::Device& device) {
          return std::make_unique<ResolveGpu>(device, texels_, *room_);
      })
{}

TexelShading ResolveEngine::resolve(SolvedRoom& room, const LampPowers& powers)
{
    const auto asked = std::make_shared<const Asked>(Asked{powers, room.found.shines});
    SettledLight light;
    const std::unique_lock lock(mutex_);
    room_ = &room;
    const bool isSettled = gpu_.compute([&](ResolveGpu& gpu) {
        gpu.gather(asked->powers, asked->shines);
        light = settledBy(gpu);
    });
    if (!isSettled) {
        relamp::resolve(texels_, room, powers);
        return shadingOf(texels_, room);
    }
    relamp::resolve(texels_, room, powers, std::move(light));
    return [self = shared_from_this(), asked, onCpu = shadingOf(texels_, room)](
               size_t page, size_t begin, const TexelBlock& block, ShadingBlock& out) {
        const auto irradiance = self->irradianceOf(asked, page);
        if (!irradiance) return onCpu(page, begin, block, out);
        irradiance->copy(begin, block.count, out);
        toShading(out.direct, block.count);
        toShading(out.indirect, block.count);
    };
}

/// Null where the CPU has to do it.
std::shared_ptr<const PageIrradiance>
ResolveEngine::irradianceOf(const std::shared_ptr<const Asked>& asked, size_t page)
{
    const std::unique_lock lock(mutex_);
    if (irradiance_ && lit_ == asked && page_ == page) return irradiance_;
    irradiance_ = nullptr;
    gpu_.compute([&](ResolveGpu& gpu) {
        gpu.gather(asked->powers, asked->shines); // nothing where these are still its own
        gpu.shade(page);
        irradiance_ = std::make_shared<const PageIrradiance>(gpu.irradiance());
        lit_ = asked;
        page_ = page;
    });
    return irradiance_;
}

} // namespace relamp
