#include "gpu/device.h"

#include "gpu/check.h"
#include "relamp/error.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace relamp::gpu
{
namespace
{

/// What `find` finds for an engine: where that is nothing, there is another engine.
template<class Find>
auto foundForEngine(const Find& find)
{
    try {
        return find();
    } catch (const Error& error) {
        throw Error(error.code(), fmt::format("{}; --engine cpu does without", error.what()));
    }
}

/// What programs are written for, as Instance::candidates() looks for it.
constexpr VkPhysicalDeviceVulkan12Features kForPrograms{
    .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
    .scalarBlockLayout = VK_TRUE,
    .hostQueryReset = VK_TRUE,
    .bufferDeviceAddress = VK_TRUE};

VkDevice opened(const Instance::Candidate& chosen, const void* features,
                std::span<const char* const> extensions)
{
    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = chosen.queueFamily;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo create{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, features};
    create.queueCreateInfoCount = 1;
    create.pQueueCreateInfos = &queue;
    create.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    create.ppEnabledExtensionNames = extensions.data();
    VkDevice device = VK_NULL_HANDLE;
    check(vkCreateDevice(chosen.handle, &create, nullptr, &device), "opening the device");
    return device;
}

} // namespace

Device::Device(std::shared_ptr<const Instance> instance, Instance::Candidate chosen,
               const void* features, std::span<const char* const> extensions)
    : instance_(std::move(instance)), chosen_(std::move(chosen)),
      device_(opened(chosen_, features, extensions))
{
    vkGetDeviceQueue(handle(), chosen_.queueFamily, 0, &queue_);

    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = chosen_.queueFamily;
    commandPool_ =
        owned(handle(), vkCreateCommandPool, vkDestroyCommandPool, pool, "opening the device");

    const VkPushConstantRange arguments{VK_SHADER_STAGE_COMPUTE_BIT, 0, kArgumentBytes};
    VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &arguments;
    pipelineLayout_ = owned(handle(), vkCreatePipelineLayout, vkDestroyPipelineLayout, layout,
                            "opening the device");
}

Device::Device(const std::shared_ptr<const Instance>& instance, const std::string& wish)
    : Device(instance, foundForEngine([&] { return instance->choose(wish); }), &kForPrograms, {})
{}

Device::Device(const std::string& wish, Validation validation)
    : Device(foundForEngine([&] { return std::make_shared<const Instance>(validation); }), wish)
{}

Device::~Device() = default;

void Device::Close::operator()(VkDevice device) const
{
    vkDestroyDevice(device, nullptr);
}

uint64_t Device::largestAllocation() const
{
    VkPhysicalDeviceMaintenance3Properties limits{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &limits};
    vkGetPhysicalDeviceProperties2(physical(), &all);
    return limits.maxMemoryAllocationSize;
}

void Device::wait() const
{
    vkDeviceWaitIdle(handle());
}

std::unique_ptr<Device> deviceFor(const EngineOptions& options)
{
    if (options.engine == Engine::cpu) return nullptr;
    if (options.engine == Engine::automatic && options.gpu.empty()) {
        const std::vector<GpuDevice> devices = gpuDevices();
        if (std::none_of(devices.begin(), devices.end(),
                         [](const GpuDevice& device) { return device.isReal(); }))
            return nullptr;
    }
    return std::make_unique<Device>(options.gpu);
}

} // namespace relamp::gpu

namespace relamp
{

void checkDevice(const EngineOptions& options)
{
    if (options.engine == Engine::gpu || (options.engine != Engine::cpu && !options.gpu.empty()))
        gpu::foundForEngine([&] { return gpu::Instance().choose(options.gpu); });
}

} // namespace relamp
