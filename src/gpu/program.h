#pragma once

#include "gpu/device.h"
#include "gpu/owned.h"
#include "gpu/vulkan.h"
#include "relamp/api.h"

#include <span>

namespace relamp::gpu
{

/// A shader as the driver takes it.
RELAMP_API Owned<VkShaderModule> shaderOf(const Device& device, std::span<const uint32_t> spirv);

/// A compute shader, ready to run.
class Program
{
public:
    Program(const Device& device, std::span<const uint32_t> spirv);

    [[nodiscard]] VkPipeline handle() const { return pipeline_.get(); }
    /// Threads of a workgroup, as the shader says.
    [[nodiscard]] uint32_t groupSize() const { return groupSize_; }

private:
    uint32_t groupSize_;
    Owned<VkPipeline> pipeline_;
};

} // namespace relamp::gpu
