#pragma once

#include "device.h"
#include "texture_pixels.h"

#include <cstddef>
#include <span>

/// Changes what an image is ready for; everything before it ends first.
void changeLayout(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect,
                  VkImageLayout from, VkImageLayout to);

/// Memory that both the program and the device see.
class Buffer
{
public:
    Buffer() = default;
    Buffer(const Device& device, size_t bytes, VkBufferUsageFlags usage);

    template<class T>
    Buffer(const Device& device, std::span<const T> values, VkBufferUsageFlags usage)
        : Buffer(device, values.size_bytes(), usage)
    {
        write(std::as_bytes(values));
    }

    [[nodiscard]] VkBuffer get() const { return buffer_.get(); }
    [[nodiscard]] size_t bytes() const { return bytes_; }
    void write(std::span<const std::byte> bytes);
    [[nodiscard]] const std::byte* mapped() const { return mapped_; }

private:
    OwnedBuffer buffer_;
    OwnedMemory memory_;
    size_t bytes_ = 0;
    std::byte* mapped_ = nullptr; // as long as the memory lives
};

/// An image on the device with its only view.
class DeviceImage
{
public:
    DeviceImage() = default;
    DeviceImage(const Device& device, const VkImageCreateInfo& info, VkImageAspectFlags aspect);

    [[nodiscard]] VkImage get() const { return image_.get(); }
    [[nodiscard]] VkImageView view() const { return view_.get(); }
    [[nodiscard]] explicit operator bool() const { return static_cast<bool>(image_); }

private:
    OwnedImage image_;
    OwnedMemory memory_;
    OwnedView view_;
};

/// Brings pixels with all their levels onto the device, ready to be sampled.
DeviceImage uploaded(const Device& device, const TexturePixels& pixels);
