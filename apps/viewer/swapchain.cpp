#include "swapchain.h"

#include "device_image.h"

#include "gpu/commands.h"

#include <algorithm>

namespace gpu = relamp::gpu;

namespace
{

gpu::Owned<VkSemaphore> semaphore(const WindowDevice& device)
{
    const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    return gpu::owned(device.handle(), vkCreateSemaphore, vkDestroySemaphore, info,
                      "making a semaphore");
}

VkSurfaceFormatKHR formatOf(const WindowDevice& device)
{
    uint32_t count = 0;
    vkGetPhysicalDeviceSurfaceFormatsKHR(device.gpu().physical(), device.surface(), &count,
                                         nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    vkGetPhysicalDeviceSurfaceFormatsKHR(device.gpu().physical(), device.surface(), &count,
                                         formats.data());
    // Pictures are encoded for the screen already, so the copy must not encode them again.
    for (const VkSurfaceFormatKHR& format : formats)
        if (format.format == VK_FORMAT_B8G8R8A8_UNORM || format.format == VK_FORMAT_R8G8B8A8_UNORM)
            return format;
    return formats.empty()
               ? VkSurfaceFormatKHR{VK_FORMAT_B8G8R8A8_UNORM, VK_COLOR_SPACE_SRGB_NONLINEAR_KHR}
               : formats[0];
}

} // namespace

Swapchain::Swapchain(const WindowDevice& device, VkExtent2D size, bool waits)
    : device_(device), waits_(waits)
{
    resize(size);
}

VkPresentModeKHR Swapchain::presentMode() const
{
    uint32_t count = 0;
    vkGetPhysicalDeviceSurfacePresentModesKHR(device_.gpu().physical(), device_.surface(), &count,
                                              nullptr);
    std::vector<VkPresentModeKHR> modes(count);
    vkGetPhysicalDeviceSurfacePresentModesKHR(device_.gpu().physical(), device_.surface(), &count,
                                              modes.data());
    const auto has = [&](VkPresentModeKHR mode) {
        return std::find(modes.begin(), modes.end(), mode) != modes.end();
    };
    if (!waits_ && has(VK_PRESENT_MODE_IMMEDIATE_KHR)) return VK_PRESENT_MODE_IMMEDIATE_KHR;
    if (!waits_ && has(VK_PRESENT_MODE_MAILBOX_KHR)) return VK_PRESENT_MODE_MAILBOX_KHR;
    return VK_PRESENT_MODE_FIFO_KHR;
}

void Swapchain::resize(VkExtent2D size)
{
    device_.gpu().wait();
    VkSurfaceCapabilitiesKHR can;
    gpu::check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.gpu().physical(),
                                                         device_.surface(), &can),
               "asking for the window's size");
    const bool isFixed = can.currentExtent.width != ~0u;
    size_ =
        isFixed
            ? can.currentExtent
            : VkExtent2D{
                  std::clamp(size.width, can.minImageExtent.width, can.maxImageExtent.width),
                  std::clamp(size.height, can.minImageExtent.height, can.maxImageExtent.height)};
    if (size_.width == 0 || size_.height == 0) return; // an icon; nothing can be shown
    const VkSurfaceFormatKHR format = formatOf(device_);
    VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
    info.surface = device_.surface();
    info.minImageCount = can.maxImageCount == 0
                             ? can.minImageCount + 1
                             : std::min(can.minImageCount + 1, can.maxImageCount);
    info.imageFormat = format.format;
    info.imageColorSpace = format.colorSpace;
    info.imageExtent = size_;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.preTransform = can.currentTransform;
    info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    info.presentMode = presentMode();
    info.clipped = VK_TRUE;
    info.oldSwapchain = chain_.get();
    chain_ = gpu::owned(device_.handle(), vkCreateSwapchainKHR, vkDestroySwapchainKHR, info,
                        "preparing the window");
    uint32_t count = 0;
    vkGetSwapchainImagesKHR(device_.handle(), chain_.get(), &count, nullptr);
    images_.resize(count);
    vkGetSwapchainImagesKHR(device_.handle(), chain_.get(), &count, images_.data());
    drawn_.clear();
    for (uint32_t i = 0; i < count; ++i) drawn_.push_back(semaphore(device_));
    acquired_ = semaphore(device_);
}

void Swapchain::record(VkCommandBuffer commands, VkImage picture, VkExtent2D pictureSize,
                       VkImage shown) const
{
    changeLayout(commands, shown, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    VkImageBlit blit{};
    blit.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    blit.srcOffsets[1] = {static_cast<int32_t>(pictureSize.width),
                          static_cast<int32_t>(pictureSize.height), 1};
    blit.dstSubresource = blit.srcSubresource;
    blit.dstOffsets[1] = {static_cast<int32_t>(size_.width), static_cast<int32_t>(size_.height), 1};
    vkCmdBlitImage(commands, picture, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, shown,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit, VK_FILTER_NEAREST);
    changeLayout(commands, shown, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                 VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
}

bool Swapchain::show(const std::function<void(VkCommandBuffer)>& draw, VkImage picture,
                     VkExtent2D pictureSize)
{
    if (size_.width == 0 || size_.height == 0) return false;
    uint32_t index = 0;
    const VkResult acquired = vkAcquireNextImageKHR(device_.handle(), chain_.get(), ~0ull,
                                                    acquired_.get(), nullptr, &index);
    if (acquired == VK_ERROR_OUT_OF_DATE_KHR) return false;
    gpu::check(acquired, "waiting for the window");
    VkSemaphore drawn = drawn_[index].get();
    gpu::Commands commands(device_.gpu());
    draw(commands.handle());
    record(commands.handle(), picture, pictureSize, images_[index]);
    commands.start(acquired_.get(), drawn);

    VkSwapchainKHR chain = chain_.get();
    VkPresentInfoKHR present{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
    present.waitSemaphoreCount = 1;
    present.pWaitSemaphores = &drawn;
    present.swapchainCount = 1;
    present.pSwapchains = &chain;
    present.pImageIndices = &index;
    const VkResult presented = vkQueuePresentKHR(device_.gpu().queue(), &present);
    // One frame at a time: what is drawn from may be changed as soon as this returns.
    commands.wait();
    if (presented == VK_ERROR_OUT_OF_DATE_KHR) return false;
    gpu::check(presented, "showing the picture");
    return presented != VK_SUBOPTIMAL_KHR;
}
