#pragma once

#include "window_device.h"

#include <functional>
#include <vector>

/// What the window shows: copies of a picture.
class Swapchain
{
public:
    /// `size` is the window's, in pixels. Without `waits`, pictures are shown as fast as they come.
    Swapchain(const WindowDevice& device, VkExtent2D size, bool waits);

    /// Records and runs `draw`, then shows `picture`, which `draw` leaves ready to be copied from.
    /// False where the window has another size by now and nothing was shown.
    [[nodiscard]] bool show(const std::function<void(VkCommandBuffer)>& draw, VkImage picture,
                            VkExtent2D pictureSize);
    void resize(VkExtent2D size);

private:
    void record(VkCommandBuffer commands, VkImage picture, VkExtent2D pictureSize,
                VkImage shown) const;
    [[nodiscard]] VkPresentModeKHR presentMode() const;

    using Semaphore = relamp::gpu::Owned<VkSemaphore>;

    const WindowDevice& device_;
    bool waits_;
    VkExtent2D size_{};
    relamp::gpu::Owned<VkSwapchainKHR> chain_;
    std::vector<VkImage> images_;
    Semaphore acquired_;
    std::vector<Semaphore> drawn_; // one an image
};
