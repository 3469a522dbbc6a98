#include "gpu/buffer.h"

#include "gpu/check.h"
#include "gpu/commands.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace relamp::gpu
{
namespace
{

constexpr size_t kStaged = size_t{16} << 20; // bytes that go over at once

std::string tried(size_t size)
{
    return fmt::format("reserving {:.0f} MB", 1e-6 * static_cast<double>(size));
}

/// The first type of memory that has all `flags` and is among `allowed`.
std::optional<uint32_t> memoryType(const Device& device, uint32_t allowed,
                                   VkMemoryPropertyFlags flags)
{
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(device.physical(), &memory);
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        if ((allowed >> i & 1u) != 0 && (memory.memoryTypes[i].propertyFlags & flags) == flags)
            return i;
    return std::nullopt;
}

/// Throws where the driver takes no buffer so large, however much memory there is.
void checkSize(const Device& device, size_t size)
{
    VkPhysicalDeviceMaintenance3Properties limits{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &limits};
    vkGetPhysicalDeviceProperties2(device.physical(), &all);
    if (size > limits.maxMemoryAllocationSize) check(VK_ERROR_OUT_OF_DEVICE_MEMORY, tried(size));
}

uint32_t memoryTypeFor(const Device& device, uint32_t allowed, Buffer::Place place)
{
    constexpr VkMemoryPropertyFlags kMapped =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    if (place == Buffer::Place::device)
        return memoryType(device, allowed, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT).value_or(0);
    if (const auto cached =
            memoryType(device, allowed, kMapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT))
        return *cached; // reading back from what is not cached takes ten times as long
    return memoryType(device, allowed, kMapped).value_or(0);
}

} // namespace

Buffer::Buffer(const Device& device, size_t size, Place place) : device_(&device), size_(size)
{
    assert(size > 0);
    checkSize(device, size);
    VkBufferCreateInfo create{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    create.size = size;
    create.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                   VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    check(vkCreateBuffer(device.handle(), &create, nullptr, &buffer_), tried(size));
    try {
        VkMemoryRequirements needs;
        vkGetBufferMemoryRequirements(device.handle(), buffer_, &needs);
        VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO};
        flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
        VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &flags};
        allocate.allocationSize = needs.size;
        allocate.memoryTypeIndex = memoryTypeFor(device, needs.memoryTypeBits, place);
        check(vkAllocateMemory(device.handle(), &allocate, nullptr, &memory_), tried(size));
        check(vkBindBufferMemory(device.handle(), buffer_, memory_, 0), tried(size));
        VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
        info.buffer = buffer_;
        address_ = vkGetBufferDeviceAddress(device.handle(), &info);
        if (place == Place::device) return;
        void* mapped = nullptr;
        check(vkMapMemory(device.handle(), memory_, 0, VK_WHOLE_SIZE, 0, &mapped), tried(size));
        mapped_ = static_cast<std::byte*>(mapped);
    } catch (...) {
        release();
        throw;
    }
}

Buffer::~Buffer()
{
    release();
}

Buffer::Buffer(Buffer&& other) noexcept
    : device_(other.device_), size_(std::exchange(other.size_, 0)),
      buffer_(std::exchange(other.buffer_, nullptr)),
      memory_(std::exchange(other.memory_, nullptr)), address_(std::exchange(other.address_, 0)),
      mapped_(std::exchange(other.mapped_, nullptr))
{}

Buffer& Buffer::operator=(Buffer&& other) noexcept
{
    std::swap(device_, other.device_);
    std::swap(size_, other.size_);
    std::swap(buffer_, other.buffer_);
    std::swap(memory_, other.memory_);
    std::swap(address_, other.address_);
    std::swap(mapped_, other.mapped_);
    return *this;
}

void Buffer::release()
{
    vkDestroyBuffer(device_->handle(), buffer_, nullptr);
    vkFreeMemory(device_->handle(), memory_, nullptr);
}

void Buffer::upload(std::span<const std::byte> from)
{
    assert(from.size() <= size_);
    if (from.empty()) return;
    const Buffer staging(*device_, std::min(kStaged, from.size()), Place::host);
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
    const Buffer staging(*device_, std::min(kStaged, to.size()), Place::host);
    for (size_t at = 0; at < to.size(); at += kStaged) {
        const size_t count = std::min(kStaged, to.size() - at);
        Commands commands(*device_);
        commands.copy(*this, at, staging, 0, count);
        commands.run();
        std::memcpy(to.data() + at, staging.bytes().data(), count);
    }
}

} // namespace relamp::gpu
