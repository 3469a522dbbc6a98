#pragma once

#include "device.h"

#include <vector>

/// What the window shows: copies of a picture.
class Swapchain
{
public:
    /// `size` is the window's, in pixels. Without `waits`, pictures are shown as fast as they come.
    Swapchain(const Device& device, VkExtent2D size, bool waits);

    /// Records and runs `draw`, then shows `picture`, which `draw` leaves ready to be copied from.
    /// False where the window has another size by now and nothing was shown.
    [[nodiscard]] bool show(const std::function<void(VkCommandBuffer)>& draw, VkImage picture,
                            VkExtent2D pictureSize);
    void resize(VkExtent2D size);

private:
    void record(const std::function<void(VkCommandBuffer)>& draw, VkImage picture,
                VkExtent2D pictureSize, VkImage shown);
    [[nodiscard]] VkPresentModeKHR presentMode() const;

    using OwnedChain = Owned<VkSwapchainKHR, &vkDestroySwapchainKHR>;

    const Device& device_;
    bool waits_;
    VkExtent2D size_{};
    OwnedChain chain_;
    std::vector<VkImage> images_;
    OwnedCommandPool pool_;
    VkCommandBuffer commands_ = nullptr;
    OwnedSemaphore acquired_;
    std::vector<OwnedSemaphore> drawn_; // one an image
    OwnedFence done_;
};
