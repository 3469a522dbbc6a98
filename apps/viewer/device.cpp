#include "device.h"

#include "relamp/devices.h"
#include "relamp/error.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include <unistd.h>

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>
#include <fmt/format.h>

namespace
{

constexpr const char* kNoDriver =
    "no Vulkan driver was found; install the one of your graphics card, or mesa-vulkan-drivers, "
    "which draws without one";

[[noreturn]] void noDevice(const std::string& sentence)
{
    throw relamp::Error(relamp::ErrorCode::unsupported, sentence);
}

/// The family of queues that draw and present in the window.
std::optional<uint32_t> familyOf(VkPhysicalDevice physical, VkSurfaceKHR surface)
{
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    for (uint32_t f = 0; f < count; ++f) {
        VkBool32 presents = VK_FALSE;
        vkGetPhysicalDeviceSurfaceSupportKHR(physical, f, surface, &presents);
        if (presents == VK_TRUE && (families[f].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0) return f;
    }
    return std::nullopt;
}

/// As relamp::GpuDevice::id.
std::array<uint8_t, 16> idOf(VkPhysicalDevice physical)
{
    VkPhysicalDeviceIDProperties id{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES};
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &id};
    vkGetPhysicalDeviceProperties2(physical, &all);
    return std::to_array(id.deviceUUID);
}

int rankOf(VkPhysicalDeviceType type)
{
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 4;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    default:
        return 1;
    }
}

} // namespace

void check(VkResult result, const char* step)
{
    if (result == VK_SUCCESS || result == VK_SUBOPTIMAL_KHR) return;
    const char* reason =
        result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY
            ? "; its memory is full, scale the scan's textures down"
        : result == VK_ERROR_DEVICE_LOST ? "; the device was lost, start the viewer again"
                                         : "";
    noDevice(fmt::format("Vulkan: {} failed ({}){}", step, static_cast<int>(result), reason));
}

Device::Device(GLFWwindow* window, const Wish& wish)
{
    createInstance();
    try {
        createSurface(window);
        choosePhysical(wish.gpu);
    } catch (const relamp::Error&) {
        closeInstance();
        throw;
    }
    // All Vulkan devices can do four samples.
    const bool isSmooth =
        wish.smooth == Smooth::on || (wish.smooth == Smooth::automatic && isHardware_);
    if (isSmooth) samples_ = VK_SAMPLE_COUNT_4_BIT;
    createDevice();
}

Device::~Device()
{
    vkDeviceWaitIdle(device_);
    pool_ = {};
    vkDestroyDevice(device_, nullptr);
    closeInstance();
}

void Device::closeInstance()
{
    vkDestroySurfaceKHR(instance_, surface_, nullptr);
    vkDestroyInstance(instance_, nullptr);
}

void Device::createInstance()
{
    if (glfwVulkanSupported() == GLFW_FALSE) noDevice(kNoDriver);
    uint32_t count = 0;
    const char** extensions = glfwGetRequiredInstanceExtensions(&count);
    VkApplicationInfo app{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    app.pApplicationName = "relamp";
    app.apiVersion = VK_API_VERSION_1_2;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &app;
    info.enabledExtensionCount = count;
    info.ppEnabledExtensionNames = extensions;
    const VkResult result = vkCreateInstance(&info, nullptr, &instance_);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER || result == VK_ERROR_EXTENSION_NOT_PRESENT)
        noDevice(kNoDriver);
    check(result, "starting it");
}

void Device::createSurface(GLFWwindow* window)
{
    if (glfwCreateWindowSurface(instance_, window, nullptr, &surface_) != VK_SUCCESS)
        noDevice("Vulkan cannot draw in windows of this display; a driver of its kind is missing");
}

void Device::choosePhysical(const std::string& wish)
{
    std::optional<relamp::GpuDevice> wanted; // that the library knows by this name
    if (!wish.empty()) wanted = relamp::gpuDevice(wish);
    uint32_t count = 0;
    vkEnumeratePhysicalDevices(instance_, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    vkEnumeratePhysicalDevices(instance_, &count, devices.data());
    int best = 0;
    for (VkPhysicalDevice candidate : devices) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(candidate, &properties);
        const std::optional<uint32_t> family = familyOf(candidate, surface_);
        const int rank = rankOf(properties.deviceType);
        if (!family || properties.apiVersion < VK_API_VERSION_1_2 || rank <= best) continue;
        if (wanted && idOf(candidate) != wanted->id) continue;
        best = rank;
        take(candidate, *family);
    }
    if (physical_ != nullptr) return;
    if (wanted)
        noDevice(
            fmt::format("{} cannot draw in this window; leave --gpu out, or name a device that "
                        "can (relamp devices lists them)",
                        wanted->name));
    noDevice(
        "no Vulkan 1.2 device can draw in this window; install the driver of your graphics card, "
        "or mesa-vulkan-drivers, which draws without one");
}

void Device::take(VkPhysicalDevice physical, uint32_t family)
{
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    physical_ = physical;
    family_ = family;
    isHardware_ = properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU;
    name_ = properties.deviceName;
}

TextureLimits Device::textureLimits() const
{
    VkPhysicalDeviceMaintenance3Properties sizes{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &sizes};
    vkGetPhysicalDeviceProperties2(physical_, &all);
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory);
    uint64_t largest = 0;
    for (uint32_t heap = 0; heap < memory.memoryHeapCount; ++heap)
        if ((memory.memoryHeaps[heap].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0)
            largest = std::max<uint64_t>(largest, memory.memoryHeaps[heap].size);
    // Software tells of a heap that is not there; it takes the machine's memory, as all else does.
    if (!isHardware_)
        largest = static_cast<uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                  static_cast<uint64_t>(sysconf(_SC_PAGE_SIZE)) / 2;
    return {all.properties.limits.maxImageDimension2D, sizes.maxMemoryAllocationSize, largest / 2};
}

void Device::createDevice()
{
    VkPhysicalDeviceFeatures available;
    vkGetPhysicalDeviceFeatures(physical_, &available);
    VkPhysicalDeviceFeatures wanted{};
    isAnisotropic_ = isHardware_ && available.samplerAnisotropy == VK_TRUE;
    wanted.samplerAnisotropy = isAnisotropic_ ? VK_TRUE : VK_FALSE;

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    const char* extension = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
    info.pEnabledFeatures = &wanted;
    check(vkCreateDevice(physical_, &info, nullptr, &device_), "opening the device");
    vkGetDeviceQueue(device_, family_, 0, &queue_);

    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.queueFamilyIndex = family_;
    VkCommandPool created = nullptr;
    check(vkCreateCommandPool(device_, &pool, nullptr, &created), "making a command pool");
    pool_ = {device_, created};
}

OwnedMemory Device::allocate(const VkMemoryRequirements& needs,
                             VkMemoryPropertyFlags properties) const
{
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory);
    for (uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
        const bool fits = (needs.memoryTypeBits >> type & 1u) != 0 &&
                          (memory.memoryTypes[type].propertyFlags & properties) == properties;
        if (!fits) continue;
        VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
        info.allocationSize = needs.size;
        info.memoryTypeIndex = type;
        VkDeviceMemory made = nullptr;
        check(vkAllocateMemory(device_, &info, nullptr, &made), "taking memory");
        return {device_, made};
    }
    noDevice("Vulkan: the device has no memory of the kind that the viewer needs");
}

void Device::run(const std::function<void(VkCommandBuffer)>& record) const
{
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = pool_.get();
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    VkCommandBuffer commands = nullptr;
    check(vkAllocateCommandBuffers(device_, &allocate, &commands), "making commands");
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands, &begin), "recording commands");
    record(commands);
    check(vkEndCommandBuffer(commands), "recording commands");
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    check(vkQueueSubmit(queue_, 1, &submit, nullptr), "running commands");
    check(vkQueueWaitIdle(queue_), "running commands");
    vkFreeCommandBuffers(device_, pool_.get(), 1, &commands);
}
