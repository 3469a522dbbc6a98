#pragma once

#include "texture_pixels.h"

#include "gpu/device.h"
#include "gpu/owned.h"

#include <memory>
#include <string>

struct GLFWwindow;

/// Whether pixels have several samples, so that edges are smooth. Automatic: on a graphics card;
/// in software it doubles the time of a frame.
enum class Smooth { automatic, on, off };

/// The Vulkan device that draws the window; where nobody names one, the best.
class WindowDevice
{
public:
    struct Wish
    {
        std::string gpu; // as relamp::EngineOptions
        Smooth smooth = Smooth::automatic;
    };
    /// Throws relamp::Error with a sentence where no device, or not this one, can draw in `window`.
    WindowDevice(GLFWwindow* window, const Wish& wish);

    [[nodiscard]] const relamp::gpu::Device& gpu() const { return gpu_; }
    [[nodiscard]] VkDevice handle() const { return gpu_.handle(); }
    [[nodiscard]] VkSurfaceKHR surface() const { return surface_.get(); }
    /// Whether looking along a texture is worth its cost: in hardware.
    [[nodiscard]] bool isAnisotropic() const { return isAnisotropic_; }
    /// Of its memory all textures together may take half.
    [[nodiscard]] TextureLimits textureLimits() const;
    /// Of a pixel of all that is drawn.
    [[nodiscard]] VkSampleCountFlagBits samples() const { return samples_; }

private:
    std::shared_ptr<const relamp::gpu::Instance> instance_;
    relamp::gpu::Owned<VkSurfaceKHR, VkInstance> surface_;
    relamp::gpu::Device gpu_;
    bool isAnisotropic_;
    VkSampleCountFlagBits samples_;
};
