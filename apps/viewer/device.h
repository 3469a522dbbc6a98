#pragma once

#include "owned.h"
#include "texture_pixels.h"

#include <functional>
#include <string>

struct GLFWwindow;

/// Throws relamp::Error naming `step` where Vulkan says that it failed.
void check(VkResult result, const char* step);

/// Whether pixels have several samples, so that edges are smooth. Automatic: on a graphics card;
/// in software it doubles the time of a frame.
enum class Smooth { automatic, on, off };

/// The Vulkan device that draws the window, and its one queue.
///
/// Where nobody names one, it is of the fastest kind: a graphics card, then one on the processor's
/// chip, then Mesa's software device.
class Device
{
public:
    struct Wish
    {
        std::string gpu; // as relamp::EngineOptions
        Smooth smooth = Smooth::automatic;
    };
    /// Throws relamp::Error with a sentence where no device, or not this one, can draw in `window`.
    Device(GLFWwindow* window, const Wish& wish);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] VkDevice get() const { return device_; }
    [[nodiscard]] VkInstance instance() const { return instance_; }
    [[nodiscard]] VkPhysicalDevice physical() const { return physical_; }
    [[nodiscard]] VkSurfaceKHR surface() const { return surface_; }
    [[nodiscard]] VkQueue queue() const { return queue_; }
    [[nodiscard]] uint32_t family() const { return family_; }
    /// Whether looking along a texture is worth its cost: in hardware.
    [[nodiscard]] bool isAnisotropic() const { return isAnisotropic_; }
    /// Of its memory all textures together may take half.
    [[nodiscard]] TextureLimits textureLimits() const;
    /// Of a pixel of all that is drawn.
    [[nodiscard]] VkSampleCountFlagBits samples() const { return samples_; }
    [[nodiscard]] const std::string& name() const { return name_; }

    [[nodiscard]] OwnedMemory allocate(const VkMemoryRequirements& needs,
                                       VkMemoryPropertyFlags properties) const;
    /// Records commands, runs them and waits for their end.
    void run(const std::function<void(VkCommandBuffer)>& record) const;
    void wait() const { vkDeviceWaitIdle(device_); }

private:
    void createInstance();
    void createSurface(GLFWwindow* window);
    void choosePhysical(const std::string& wish);
    void take(VkPhysicalDevice physical, uint32_t family);
    void closeInstance();
    void createDevice();

    VkInstance instance_ = nullptr;
    VkSurfaceKHR surface_ = nullptr;
    VkPhysicalDevice physical_ = nullptr;
    VkDevice device_ = nullptr;
    VkQueue queue_ = nullptr;
    uint32_t family_ = 0;
    bool isHardware_ = false;
    bool isAnisotropic_ = false;
    VkSampleCountFlagBits samples_ = VK_SAMPLE_COUNT_1_BIT;
    std::string name_;
    OwnedCommandPool pool_;
};
