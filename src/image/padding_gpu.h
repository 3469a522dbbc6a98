#pragma once

#include "gpu/commands.h"

#include <functional>
#include <initializer_list>
#include <vector>

#include <glm/vec2.hpp>

namespace relamp
{

/// A page's picture on a GPU, four halves a pixel of which the last is 1 where the picture counts;
/// its mip levels are kept for fillPadding().
class GpuPicture
{
public:
    /// Nothing is covered yet.
    GpuPicture(const gpu::Device& device, uint32_t width, uint32_t height);

    /// Nothing is covered.
    void clear(gpu::Commands& commands) const { commands.clear(levels_[0].pixels.buffer()); }
    /// The picture itself, `width` * `height`.
    [[nodiscard]] const gpu::Array<glm::uvec2>& pixels() const { return levels_[0].pixels; }
    /// Bytes that one takes on a device.
    static size_t bytesOf(size_t pixels) { return pixels * sizeof(glm::uvec2) * 4 / 3; }

private:
    friend class PaddingGpu;
    struct Level
    {
        uint32_t width;
        uint32_t height;
        gpu::Array<glm::uvec2> pixels;
    };
    std::vector<Level> levels_;
};

/// fillPadding() on a GPU.
class PaddingGpu
{
public:
    explicit PaddingGpu(const gpu::Device& device);

    /// Of pictures of one size.
    void fill(gpu::Commands& commands,
              std::initializer_list<std::reference_wrapper<const GpuPicture>> pictures) const;

private:
    gpu::Program push_;
    gpu::Program pull_;
};

} // namespace relamp
