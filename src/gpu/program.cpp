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

Program::Program(const Device& device, std::span<const uint32_t> spirv)
    : device_(device), groupSize_(groupSizeOf(spirv))
{
    VkShaderModuleCreateInfo code{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    code.codeSize = spirv.size_bytes();
    code.pCode = spirv.data();
    VkShaderModule shader = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device.handle(), &code, nullptr, &shader), "loading a program");

    VkComputePipelineCreateInfo create{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    create.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    create.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    create.stage.module = shader;
    create.stage.pName = "main";
    create.layout = device.pipelineLayout();
    const VkResult made =
        vkCreateComputePipelines(device.handle(), nullptr, 1, &create, nullptr, &pipeline_);
    vkDestroyShaderModule(device.handle(), shader, nullptr);
    check(made, "compiling a program");
}

Program::~Program()
{
    vkDestroyPipeline(device_.handle(), pipeline_, nullptr);
}

} // namespace relamp::gpu
