#pragma once

#include <utility>

#include <vulkan/vulkan.h>

/// A Vulkan object of a device, destroyed with this.
template<class Handle, auto destroy>
class Owned
{
public:
    Owned() = default;
    Owned(VkDevice device, Handle handle) : device_(device), handle_(handle) {}
    ~Owned() { reset(); }
    Owned(Owned&& other) noexcept
        : device_(other.device_), handle_(std::exchange(other.handle_, nullptr))
    {}
    Owned& operator=(Owned&& other) noexcept
    {
        if (this == &other) return *this;
        reset();
        device_ = other.device_;
        handle_ = std::exchange(other.handle_, nullptr);
        return *this;
    }

    [[nodiscard]] Handle get() const { return handle_; }
    [[nodiscard]] explicit operator bool() const { return handle_ != nullptr; }

private:
    void reset()
    {
        if (handle_ != nullptr) destroy(device_, handle_, nullptr);
        handle_ = nullptr;
    }

    VkDevice device_ = nullptr;
    Handle handle_ = nullptr;
};

using OwnedBuffer = Owned<VkBuffer, &vkDestroyBuffer>;
using OwnedMemory = Owned<VkDeviceMemory, &vkFreeMemory>;
using OwnedImage = Owned<VkImage, &vkDestroyImage>;
using OwnedView = Owned<VkImageView, &vkDestroyImageView>;
using OwnedSampler = Owned<VkSampler, &vkDestroySampler>;
using OwnedRenderPass = Owned<VkRenderPass, &vkDestroyRenderPass>;
using OwnedFramebuffer = Owned<VkFramebuffer, &vkDestroyFramebuffer>;
using OwnedShader = Owned<VkShaderModule, &vkDestroyShaderModule>;
using OwnedPipeline = Owned<VkPipeline, &vkDestroyPipeline>;
using OwnedPipelineLayout = Owned<VkPipelineLayout, &vkDestroyPipelineLayout>;
using OwnedSetLayout = Owned<VkDescriptorSetLayout, &vkDestroyDescriptorSetLayout>;
using OwnedDescriptorPool = Owned<VkDescriptorPool, &vkDestroyDescriptorPool>;
using OwnedCommandPool = Owned<VkCommandPool, &vkDestroyCommandPool>;
using OwnedFence = Owned<VkFence, &vkDestroyFence>;
using OwnedSemaphore = Owned<VkSemaphore, &vkDestroySemaphore>;
