#include "gpu/instance.h"

#include "base/instruction_set.h"
#include "gpu/check.h"
#include "relamp/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <optional>
#include <tuple>

#include <fmt/format.h>
#include <tbb/task_arena.h>

namespace relamp::gpu
{
namespace
{

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

[[noreturn]] void noDevice(const std::string& why)
{
    throw Error(ErrorCode::device, "GPU: " + why);
}

template<class Item, class List>
std::vector<Item> listed(const List& list)
{
    uint32_t count = 0;
    list(&count, static_cast<Item*>(nullptr));
    std::vector<Item> items(count);
    list(&count, items.data());
    items.resize(count);
    return items;
}

bool hasValidationLayer()
{
    const auto layers = listed<VkLayerProperties>(vkEnumerateInstanceLayerProperties);
    return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, kValidationLayer) == 0;
    });
}

VkBool32 VKAPI_PTR complain(VkDebugUtilsMessageSeverityFlagBitsEXT /*severity*/,
                            VkDebugUtilsMessageTypeFlagsEXT /*type*/,
                            const VkDebugUtilsMessengerCallbackDataEXT* said, void* complaints)
{
    static_cast<std::vector<std::string>*>(complaints)->emplace_back(said->pMessage);
    return VK_FALSE;
}

GpuDevice::Type typeOf(VkPhysicalDeviceType type)
{
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return GpuDevice::Type::discrete;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return GpuDevice::Type::integrated;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return GpuDevice::Type::virtualized;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return GpuDevice::Type::software;
    default:
        return GpuDevice::Type::other;
    }
}

uint64_t memoryOf(VkPhysicalDevice device)
{
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(device, &memory);
    uint64_t largest = 0;
    for (uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if ((memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0)
            largest = std::max(largest, memory.memoryHeaps[i].size);
    return largest;
}

GpuDevice describe(VkPhysicalDevice device)
{
    VkPhysicalDeviceIDProperties id{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES};
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES,
                                            &id};
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver};
    vkGetPhysicalDeviceProperties2(device, &all);
    return {all.properties.deviceName, typeOf(all.properties.deviceType), memoryOf(device),
            fmt::format("{} {}", driver.driverName, driver.driverInfo),
            std::to_array(id.deviceUUID)};
}

/// volk's pointers are of the instance made last, which need not have the extension.
template<class Function>
Function extension(VkInstance instance, const char* name)
{
    return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

bool hasVulkan12(VkPhysicalDevice device)
{
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device, &properties);
    return properties.apiVersion >= VK_API_VERSION_1_2;
}

/// What the programs are written for beside Vulkan 1.2 itself; any desktop driver since 2020.
bool hasFeatures(VkPhysicalDevice device)
{
    VkPhysicalDeviceVulkan12Features features{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceFeatures2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &features};
    vkGetPhysicalDeviceFeatures2(device, &all);
    return features.bufferDeviceAddress != 0 && features.scalarBlockLayout != 0 &&
           features.hostQueryReset != 0;
}

std::vector<VkQueueFamilyProperties> queueFamiliesOf(VkPhysicalDevice device)
{
    return listed<VkQueueFamilyProperties>([&](uint32_t* count, VkQueueFamilyProperties* items) {
        vkGetPhysicalDeviceQueueFamilyProperties(device, count, items);
    });
}

/// A family of queues that computes; one that draws too, where there is one.
std::optional<uint32_t> computingFamilyOf(VkPhysicalDevice device)
{
    const std::vector<VkQueueFamilyProperties> families = queueFamiliesOf(device);
    for (const VkQueueFlags wanted : {VkQueueFlags{VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT},
                                      VkQueueFlags{VK_QUEUE_COMPUTE_BIT}})
        for (uint32_t i = 0; i < families.size(); ++i)
            if ((families[i].queueFlags & wanted) == wanted && families[i].timestampValidBits > 0)
                return i;
    return std::nullopt;
}

/// A family of queues that draws, and shows it in the window.
std::optional<uint32_t> drawingFamilyOf(VkInstance instance, VkPhysicalDevice device,
                                        VkSurfaceKHR window)
{
    const auto asked = extension<PFN_vkGetPhysicalDeviceSurfaceSupportKHR>(
        instance, "vkGetPhysicalDeviceSurfaceSupportKHR");
    const std::vector<VkQueueFamilyProperties> families = queueFamiliesOf(device);
    for (uint32_t i = 0; i < families.size(); ++i) {
        VkBool32 shows = VK_FALSE;
        asked(device, i, window, &shows);
        if (shows == VK_TRUE && (families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0) return i;
    }
    return std::nullopt;
}

std::string lowerCase(std::string text)
{
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

bool isNumber(const std::string& text)
{
    return !text.empty() && text.size() < 6 &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

} // namespace

Instance::Instance(Validation validation, std::span<const char* const> extensions)
{
    if (volkInitialize() != VK_SUCCESS) noDevice("this machine has no Vulkan loader (libvulkan1)");
    const bool validates = validation == Validation::on;
    if (validates && !hasValidationLayer())
        noDevice("there is no validation layer (vulkan-validationlayers)");
    std::vector<const char*> wanted(extensions.begin(), extensions.end());
    if (validates) wanted.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = "relamp";
    application.apiVersion = VK_API_VERSION_1_2;
    VkInstanceCreateInfo create{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    create.pApplicationInfo = &application;
    create.enabledLayerCount = validates ? 1 : 0;
    create.ppEnabledLayerNames = &kValidationLayer;
    create.enabledExtensionCount = static_cast<uint32_t>(wanted.size());
    create.ppEnabledExtensionNames = wanted.data();
    if (vkCreateInstance(&create, nullptr, &instance_) != VK_SUCCESS)
        noDevice("this machine has no Vulkan driver (install the one of your graphics card, or "
                 "mesa-vulkan-drivers)");
    volkLoadInstance(instance_);
    if (validates) listen();
}

Instance::~Instance()
{
    if (messenger_ != VK_NULL_HANDLE)
        extension<PFN_vkDestroyDebugUtilsMessengerEXT>(
            instance_, "vkDestroyDebugUtilsMessengerEXT")(instance_, messenger_, nullptr);
    vkDestroyInstance(instance_, nullptr);
}

void Instance::listen()
{
    VkDebugUtilsMessengerCreateInfoEXT create{
        VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    create.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                             VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    create.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                         VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    create.pfnUserCallback = complain;
    create.pUserData = &complaints_;
    check(
        extension<PFN_vkCreateDebugUtilsMessengerEXT>(instance_, "vkCreateDebugUtilsMessengerEXT")(
            instance_, &create, nullptr, &messenger_),
        "listening to the validation layer");
}

std::vector<VkPhysicalDevice> Instance::physicalDevices() const
{
    auto devices = listed<VkPhysicalDevice>(
        [&](auto... list) { return vkEnumeratePhysicalDevices(instance_, list...); });
    std::erase_if(devices, [](VkPhysicalDevice device) { return !hasVulkan12(device); });
    return devices;
}

std::vector<Instance::Candidate> Instance::candidates() const
{
    std::vector<Candidate> found;
    for (VkPhysicalDevice device : physicalDevices())
        if (const auto family = computingFamilyOf(device); family && hasFeatures(device))
            found.push_back({device, *family, describe(device)});
    return found;
}

std::vector<Instance::Candidate> Instance::candidatesFor(VkSurfaceKHR window) const
{
    std::vector<Candidate> found;
    for (VkPhysicalDevice device : physicalDevices())
        if (const auto family = drawingFamilyOf(instance_, device, window))
            found.push_back({device, *family, describe(device)});
    return found;
}

Instance::Candidate Instance::best(const std::vector<Candidate>& candidates)
{
    return *std::max_element(candidates.begin(), candidates.end(),
                             [](const Candidate& a, const Candidate& b) {
                                 const auto rank = [](const GpuDevice& d) {
                                     const bool ofItsOwn = d.type == GpuDevice::Type::discrete;
                                     return std::tuple(d.isReal(), ofItsOwn, d.memory);
                                 };
                                 return rank(a.description) < rank(b.description);
                             });
}

Instance::Candidate Instance::choose(const std::string& wish) const
{
    std::vector<Candidate> found = candidates();
    if (found.empty()) noDevice("no driver of this machine can do Vulkan 1.2");
    if (isNumber(wish) && std::stoul(wish) < found.size()) return found[std::stoul(wish)];
    std::erase_if(found, [&](const Candidate& c) {
        return lowerCase(c.description.name).find(lowerCase(wish)) == std::string::npos;
    });
    if (found.empty())
        noDevice(fmt::format("no device is called \"{}\" (relamp devices lists them)", wish));
    return best(found);
}

} // namespace relamp::gpu

namespace relamp
{

std::string cpuDevice()
{
    return fmt::format("{} threads, {}", tbb::this_task_arena::max_concurrency(),
                       nameOf(bestInstructionSet()));
}

GpuDevice gpuDevice(const std::string& wish)
{
    return gpu::Instance().choose(wish).description;
}

std::vector<GpuDevice> gpuDevices()
{
    std::vector<GpuDevice> devices;
    try {
        const gpu::Instance instance;
        for (const auto& candidate : instance.candidates())
            devices.push_back(candidate.description);
    } catch (const Error&) { // no loader, no driver: then there is none
        return {};
    }
    return devices;
}

} // namespace relamp
