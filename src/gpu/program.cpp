#include "gpu/program.h"

#include "gpu/check.h"

#include <cassert>

namespace relamp::gpu
{
namespace
{

/// SPIR-V is a header of five words, then instructions: length and code in their first word.
uint32_t groupSizeOf(std::span<const uint32_t> spirv)
{
    constexpr uint32_t kExecutionMode = 16;
    constexpr uint32_t kLocalSize = 17;
    for (size_t at = 5; at < spirv.size(); at += spirv[at] >> 16)
        if ((spirv[at] & 0xffffu) == kExecutionMode && spirv[at + 2] == kLocalSize) {
            assert(spirv[at + 4] == 1 && spirv[at + 5] == 1); // dispatch() counts in one dimension
            return spirv[at + 3];
        }
    assert(false);
    return 1;
}

} // namespace

Owned<VkShaderModule> shaderOf(const Device& device, std::span<const uint32_t> spirv)
{
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = spirv.size_bytes();
    info.pCode = spirv.data();
    return owned(device.handle(), vkCreateShaderModule, vkDestroyShaderModule, info,
                 "loading a program");
}

Program::Program(const Device& device, std::span<const uint32_t> spirv)
    : groupSize_(groupSizeOf(spirv))
{
    const Owned<VkShaderModule> shader = shaderOf(device, spirv);
    VkComputePipelineCreateInfo create{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    create.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    create.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    create.stage.module = shader.get();
    create.stage.pName = "main";
    create.layout = device.pipelineLayout();
    VkPipeline made = VK_NULL_HANDLE;
    check(vkCreateComputePipelines(device.handle(), nullptr, 1, &create, nullptr, &made),
          "compiling a program");
    pipeline_ = {device.handle(), made, vkDestroyPipeline};
}

} // namespace relamp::gpu
