#pragma once

#include "texture_pixels.h"

#include "gpu/device.h"
#include "gpu/owned.h"

/// Changes what an image is ready for; everything before it ends first.
void changeLayout(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect,
                  VkImageLayout from, VkImageLayout to);

/// An image on the device with its only view.
class DeviceImage
{
public:
    DeviceImage() = default;
    DeviceImage(const relamp::gpu::Device& device, const VkImageCreateInfo& info,
                VkImageAspectFlags aspect);

    [[nodiscard]] VkImage get() const { return image_.get(); }
    [[nodiscard]] VkImageView view() const { return view_.get(); }
    [[nodiscard]] explicit operator bool() const { return static_cast<bool>(image_); }

private:
    relamp::gpu::Owned<VkDeviceMemory> memory_;
    relamp::gpu::Owned<VkImage> image_;
    relamp::gpu::Owned<VkImageView> view_;
};

/// Brings pixels with all their levels onto the device, ready to be sampled.
DeviceImage uploaded(const relamp::gpu::Device& device, const TexturePixels& pixels);
