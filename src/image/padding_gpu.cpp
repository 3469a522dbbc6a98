#include "image/padding_gpu.h"

#include "image/padding.gpu.h"
#include "image/padding_pull.comp.h"
#include "image/padding_push.comp.h"

namespace relamp
{

GpuPicture::GpuPicture(const gpu::Device& device, uint32_t width, uint32_t height)
{
    const auto add = [&](uint32_t w, uint32_t h) {
        levels_.push_back({w, h, gpu::Array<glm::uvec2>(device, size_t{w} * h)});
    };
    add(width, height);
    while (levels_.back().width > 1 || levels_.back().height > 1)
        add((levels_.back().width + 1) / 2, (levels_.back().height + 1) / 2);
    gpu::Commands commands(device);
    clear(commands);
    commands.run();
}

PaddingGpu::PaddingGpu(const gpu::Device& device)
    : push_(device, kPaddingPushSpirv), pull_(device, kPaddingPullSpirv)
{}

void PaddingGpu::fill(
    gpu::Commands& commands,
    std::initializer_list<std::reference_wrapper<const GpuPicture>> pictures) const
{
    const auto record = [&](const gpu::Program& program, size_t fineLevel, size_t written) {
        for (const GpuPicture& picture : pictures) {
            const auto& fine = picture.levels_[fineLevel];
            const auto& coarse = picture.levels_[fineLevel + 1];
            const size_t count = picture.levels_[written].pixels.count();
            commands.dispatch(program, count,
                              PaddingArguments{fine.pixels.ref(), coarse.pixels.ref(), fine.width,
                                               fine.height, coarse.width,
                                               static_cast<uint32_t>(count)});
        }
        commands.barrier();
    };
    const size_t coarsest = pictures.begin()->get().levels_.size() - 1;
    for (size_t level = 0; level < coarsest; ++level) record(push_, level, level + 1);
    for (size_t level = coarsest; level-- > 0;) record(pull_, level, level);
}

} // namespace relamp
