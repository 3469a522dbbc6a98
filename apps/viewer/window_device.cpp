#include "window_device.h"

#include "relamp/devices.h"
#include "relamp/error.h"

#include <array>
#include <span>
#include <vector>

#include <unistd.h>

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>
#include <fmt/format.h>

namespace gpu = relamp::gpu;

namespace
{

constexpr std::array<const char*, 1> kExtensions{VK_KHR_SWAPCHAIN_EXTENSION_NAME};

[[noreturn]] void noDevice(const std::string& sentence)
{
    throw relamp::Error(relamp::ErrorCode::device, sentence);
}

std::shared_ptr<const gpu::Instance> instanceForWindows()
{
    uint32_t count = 0;
    const char** extensions = glfwGetRequiredInstanceExtensions(&count);
    return std::make_shared<const gpu::Instance>(gpu::Validation::off,
                                                 std::span(extensions, count));
}

gpu::Owned<VkSurfaceKHR, VkInstance> surfaceOf(VkInstance instance, GLFWwindow* window)
{
    VkSurfaceKHR made = nullptr;
    if (glfwCreateWindowSurface(instance, window, nullptr, &made) != VK_SUCCESS)
        noDevice("Vulkan cannot draw in windows of this display; a driver of its kind is missing");
    return {instance, made, vkDestroySurfaceKHR};
}

gpu::Instance::Candidate chosen(const gpu::Instance& instance, VkSurfaceKHR surface,
                                const std::string& wish)
{
    std::vector<gpu::Instance::Candidate> found = instance.candidatesFor(surface);
    if (wish.empty() && found.empty())
        noDevice("no Vulkan 1.2 device can draw in this window; install the driver of your "
                 "graphics card, or mesa-vulkan-drivers, which draws without one");
    if (wish.empty()) return gpu::Instance::best(found);
    const relamp::GpuDevice wanted = relamp::gpuDevice(wish); // that the library knows by this name
    for (const gpu::Instance::Candidate& candidate : found)
        if (candidate.description.id == wanted.id) return candidate;
    noDevice(fmt::format("{} cannot draw in this window; leave --gpu out, or name a device that "
                         "can (relamp devices lists them)",
                         wanted.name));
}

bool canLookAlong(VkPhysicalDevice device, const relamp::GpuDevice& description)
{
    VkPhysicalDeviceFeatures available;
    vkGetPhysicalDeviceFeatures(device, &available);
    return description.isReal() && available.samplerAnisotropy != 0;
}

gpu::Device opened(const std::shared_ptr<const gpu::Instance>& instance,
                   const gpu::Instance::Candidate& device)
{
    VkPhysicalDeviceFeatures2 wanted{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    wanted.features.samplerAnisotropy = canLookAlong(device.handle, device.description);
    return {instance, device, &wanted, kExtensions};
}

/// All Vulkan devices can do four.
VkSampleCountFlagBits samplesOf(Smooth smooth, bool isReal)
{
    const bool isSmooth = smooth == Smooth::on || (smooth == Smooth::automatic && isReal);
    return isSmooth ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT;
}

} // namespace

WindowDevice::WindowDevice(GLFWwindow* window, const Wish& wish)
    : instance_(instanceForWindows()), surface_(surfaceOf(instance_->handle(), window)),
      gpu_(opened(instance_, chosen(*instance_, surface_.get(), wish.gpu))),
      isAnisotropic_(canLookAlong(gpu_.physical(), gpu_.description())),
      samples_(samplesOf(wish.smooth, gpu_.description().isReal()))
{}

TextureLimits WindowDevice::textureLimits() const
{
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(gpu_.physical(), &properties);
    uint64_t memory = gpu_.description().memory;
    // Software tells of a heap that is not there; it takes the machine's memory, as all else does.
    if (!gpu_.description().isReal())
        memory = static_cast<uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                 static_cast<uint64_t>(sysconf(_SC_PAGE_SIZE)) / 2;
    return {properties.limits.maxImageDimension2D, gpu_.largestAllocation(), memory / 2};
}
