#pragma once

#include "gpu/compute.h"
#include "gpu/device.h"
#include "gpu/memory.h"
#include "gpu/owned.h"
#include "gpu/vulkan.h"
#include "relamp/api.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace relamp::gpu
{

/// Bytes on a device.
class RELAMP_API Buffer
{
public:
    using Place = gpu::Place;
    /// What programs read and write, by address().
    static constexpr VkBufferUsageFlags kOfPrograms =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
        VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;

    Buffer() = default; // none at all
    /// `size` > 0. Throws Error(device) where there is no room for it.
    Buffer(const Device& device, size_t size, Place place = Place::device,
           VkBufferUsageFlags usage = kOfPrograms);

    [[nodiscard]] VkBuffer handle() const { return buffer_.get(); }
    [[nodiscard]] size_t size() const { return size_; }
    [[nodiscard]] uint64_t address() const { return address_; }
    /// In Place::host.
    [[nodiscard]] std::span<std::byte> bytes() const { return {mapped_, size_}; }
    [[nodiscard]] const Device& device() const { return *device_; }

    /// Copies to and from the start of a buffer in Place::device that may be copied to or from;
    /// each waits until it is done.
    void upload(std::span<const std::byte> from);
    void download(std::span<std::byte> to) const;

private:
    const Device* device_ = nullptr;
    size_t size_ = 0;
    Owned<VkDeviceMemory> memory_;
    Owned<VkBuffer> buffer_;
    uint64_t address_ = 0;
    std::byte* mapped_ = nullptr;
};

/// A buffer of `count` elements; none at all has room for one, so that it has an address.
template<class T>
class Array
{
public:
    Array(const Device& device, size_t count)
        : buffer_(device, std::max<size_t>(count, 1) * sizeof(T)), count_(count)
    {}
    Array(const Device& device, const std::vector<T>& values) : Array(device, values.size())
    {
        upload(values);
    }

    [[nodiscard]] size_t count() const { return count_; }
    [[nodiscard]] const Buffer& buffer() const { return buffer_; }
    /// What a program knows it by.
    [[nodiscard]] ArrayRef<T> ref() const { return {buffer_.address()}; }

    void upload(std::span<const T> values)
    {
        assert(values.size() <= count_);
        buffer_.upload(std::as_bytes(values));
    }
    [[nodiscard]] std::vector<T> download() const
    {
        std::vector<T> values(count_);
        buffer_.download(std::as_writable_bytes(std::span(values)));
        return values;
    }

private:
    Buffer buffer_;
    size_t count_;
};

} // namespace relamp::gpu
