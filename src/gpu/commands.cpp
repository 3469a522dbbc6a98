#include "gpu/commands.h"

#include "gpu/check.h"

#include <algorithm>
#include <cassert>

namespace relamp::gpu
{

Commands::Commands(const Device& device) : device_(device)
{
    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    ended_ = owned(device.handle(), vkCreateFence, vkDestroyFence, fence, "writing commands");
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = device.commandPool();
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device.handle(), &allocate, &commands_), "writing commands");
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands_, &begin), "writing commands");
}

Commands::~Commands()
{
    vkFreeCommandBuffers(device_.handle(), device_.commandPool(), 1, &commands_);
}

void Commands::dispatch(const Program& program, size_t threads,
                        std::span<const std::byte> arguments)
{
    constexpr size_t kMostGroups = 65535; // along an axis: the least that Vulkan promises
    if (threads == 0) return;
    const size_t groups = (threads + program.groupSize() - 1) / program.groupSize();
    const size_t rows = (groups + kMostGroups - 1) / kMostGroups; // threadIndex() counts on
    assert(rows <= kMostGroups);
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, program.handle());
    vkCmdPushConstants(commands_, device_.pipelineLayout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                       static_cast<uint32_t>(arguments.size()), arguments.data());
    vkCmdDispatch(commands_, static_cast<uint32_t>((groups + rows - 1) / rows),
                  static_cast<uint32_t>(rows), 1);
}

void Commands::copy(const Buffer& from, size_t fromByte, const Buffer& to, size_t toByte,
                    size_t count)
{
    assert(fromByte + count <= from.size() && toByte + count <= to.size());
    const VkBufferCopy region{fromByte, toByte, count};
    vkCmdCopyBuffer(commands_, from.handle(), to.handle(), 1, &region);
}

void Commands::clear(const Buffer& buffer)
{
    vkCmdFillBuffer(commands_, buffer.handle(), 0, VK_WHOLE_SIZE, 0);
}

void Commands::barrier()
{
    constexpr VkPipelineStageFlags kStages =
        VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT |
                            VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    vkCmdPipelineBarrier(commands_, kStages, kStages, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

void Commands::mark(const std::string& name)
{
    assert(marks_.size() + 1 < kMostMarks);
    if (!stamps_) {
        VkQueryPoolCreateInfo create{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
        create.queryType = VK_QUERY_TYPE_TIMESTAMP;
        create.queryCount = kMostMarks;
        stamps_ = owned(device_.handle(), vkCreateQueryPool, vkDestroyQueryPool, create,
                        "measuring time");
        vkResetQueryPool(device_.handle(), stamps_.get(), 0, kMostMarks);
    }
    marks_.push_back(name);
    stamp();
}

void Commands::stamp()
{
    vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, stamps_.get(),
                        stampCount_++);
}

void Commands::run()
{
    start();
    wait();
}

void Commands::start(VkSemaphore ready, VkSemaphore done)
{
    if (!marks_.empty()) stamp();
    // What the host reads next, it must see.
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0,
                         1, &barrier, 0, nullptr, 0, nullptr);
    check(vkEndCommandBuffer(commands_), "writing commands");
    const VkPipelineStageFlags copies = VK_PIPELINE_STAGE_TRANSFER_BIT;
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.waitSemaphoreCount = ready != VK_NULL_HANDLE ? 1 : 0;
    submit.pWaitSemaphores = &ready;
    submit.pWaitDstStageMask = &copies;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands_;
    submit.signalSemaphoreCount = done != VK_NULL_HANDLE ? 1 : 0;
    submit.pSignalSemaphores = &done;
    check(vkQueueSubmit(device_.queue(), 1, &submit, ended_.get()), "running commands");
}

void Commands::wait()
{
    const VkFence ended = ended_.get();
    check(vkWaitForFences(device_.handle(), 1, &ended, VK_TRUE, ~0ull), "running commands");
}

std::vector<Timing> Commands::timings() const
{
    if (marks_.empty()) return {};
    std::vector<uint64_t> ticks(stampCount_);
    check(vkGetQueryPoolResults(device_.handle(), stamps_.get(), 0, stampCount_,
                                ticks.size() * sizeof(uint64_t), ticks.data(), sizeof(uint64_t),
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "measuring time");
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device_.physical(), &properties);
    const double secondsPerTick = 1e-9 * static_cast<double>(properties.limits.timestampPeriod);
    std::vector<Timing> timings;
    for (size_t i = 0; i < marks_.size(); ++i) {
        const auto same = std::find_if(timings.begin(), timings.end(),
                                       [&](const Timing& t) { return t.name == marks_[i]; });
        Timing& timing =
            same != timings.end() ? *same : timings.emplace_back(Timing{marks_[i], 0.0});
        timing.seconds += secondsPerTick * static_cast<double>(ticks[i + 1] - ticks[i]);
    }
    return timings;
}

} // namespace relamp::gpu
