#pragma once

#include "gpu/device.h"
#include "gpu/vulkan.h"

#include <span>

namespace relamp::gpu
{

/// A compute shader, ready to run.
class Program
{
public:
    Program(const Device& device, std::span<const uint32_t> spirv);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    [[nodiscard]] VkPipeline handle() const { return pipeline_; }
    /// Threads of a workgroup, as the shader says.
    [[nodiscard]] uint32_t groupSize() const { return groupSize_; }

private:
    const Device& device_;
    uint32_t groupSize_;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

} // namespace relamp::gpu
