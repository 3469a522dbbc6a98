#pragma once

#include "device_image.h"
#include "window_device.h"

#include <array>
#include <cstdint>
#include <vector>

/// A colour image and its depth, to draw into and to read again: what the window shows is copied
/// from one, so a picture of it is the same whether or not anybody sees the window.
class Target
{
public:
    Target(const WindowDevice& device, VkFormat colour, uint32_t width, uint32_t height);

    [[nodiscard]] VkRenderPass pass() const { return pass_.get(); }
    [[nodiscard]] VkExtent2D size() const { return size_; }
    [[nodiscard]] VkImage colour() const { return colour_.get(); }
    void resize(uint32_t width, uint32_t height);

    /// Everything that is drawn between lies on a ground of `clear`. Afterwards colour and depth
    /// are ready to be copied from.
    void begin(VkCommandBuffer commands, const std::array<float, 4>& clear) const;
    static void end(VkCommandBuffer commands) { vkCmdEndRenderPass(commands); }

    /// Pixels as they lie in the colour's format, row 0 on top.
    [[nodiscard]] std::vector<std::byte> pixels(size_t bytesAPixel) const;
    /// What was drawn at a pixel: 0 near .. 1 nothing.
    [[nodiscard]] float depthAt(uint32_t x, uint32_t y) const;

private:
    [[nodiscard]] std::vector<std::byte>
    read(const DeviceImage& image, const VkBufferImageCopy& part, size_t bytesAPixel) const;

    const WindowDevice& device_;
    VkFormat format_;
    VkExtent2D size_{};
    relamp::gpu::Owned<VkRenderPass> pass_;
    DeviceImage colourSamples_; // what is drawn into, where pixels have several
    DeviceImage depthSamples_;
    DeviceImage colour_; // their mean
    DeviceImage depth_;  // of one of them
    relamp::gpu::Owned<VkFramebuffer> framebuffer_;
};
