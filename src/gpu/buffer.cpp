#include "gpu/buffer.h"

#include "gpu/check.h"
#include "gpu/commands.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <string>

#include <fmt/format.h>

namespace relamp::gpu
{
namespace
{

constexpr size_t kStaged = size_t{16} << 20; // bytes that go over at once

} // namespace

Buffer::Buffer(const Device& device, size_t size, Place place, VkBufferUsageFlags usage)
    : device_(&device), size_(size)
{
    assert(size > 0);
    const std::string what = fmt::format("reserving {:.0f} MB", 1e-6 * static_cast<double>(size));
    // However much memory there is, drivers take no more in one piece.
    if (size > device.largestAllocation()) check(VK_ERROR_OUT_OF_DEVICE_MEMORY, what);
    const bool hasAddress = (usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0;
    VkBufferCreateInfo create{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    create.size = size;
    create.usage = usage;
    buffer_ = owned(device.handle(), vkCreateBuffer, vkDestroyBuffer, create, what);
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device.handle(), handle(), &needs);
    memory_ =
        allocate(device, needs, place, what,
                 hasAddress ? VkMemoryAllocateFlags{VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT} : 0u);
    check(vkBindBufferMemory(device.handle(), handle(), memory_.get(), 0), what);
    if (hasAddress) {
        VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
        info.buffer = handle();
        address_ = vkGetBufferDeviceAddress(device.handle(), &info);
    }
    if (place == Place::device) return;
    void* mapped = nullptr;
    check(vkMapMemory(device.handle(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &mapped), what);
    mapped_ = static_cast<std::byte*>(mapped);
}

void Buffer::upload(std::span<const std::byte> from)
{
    assert(from.size() <= size_);
    if (from.empty()) return;
    const Buffer staging(*device_, std::min(kStaged, from.size()), Place::host,
                         VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    for (size_t at = 0; at < from.size(); at += kStaged) {
        const size_t count = std::min(kStaged, from.size() - at);
        std::memcpy(staging.bytes().data(), from.data() + at, count);
        Commands commands(*device_);
        commands.copy(staging, 0, *this, at, count);
        commands.run();
    }
}

void Buffer::download(std::span<std::byte> to) const
{
    assert(to.size() <= size_);
    if (to.empty()) return;
    const Buffer staging(*device_, std::min(kStaged, to.size()), Place::host,
                         VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    for (size_t at = 0; at < to.size(); at += kStaged) {
        const size_t count = std::min(kStaged, to.size() - at);
        Commands commands(*device_);
        commands.copy(*this, at, staging, 0, count);
        commands.run();
        std::memcpy(to.data() + at, staging.bytes().data(), count);
    }
}

} // namespace relamp::gpu
