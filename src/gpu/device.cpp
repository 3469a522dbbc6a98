#include "gpu/device.h"

#include "gpu/check.h"
#include "relamp/error.h"

#include <algorithm>

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

VkDevice makeDevice(const Instance::Candidate& chosen)
{
    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = chosen.queueFamily;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkPhysicalDeviceVulkan12Features features{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    features.bufferDeviceAddress = VK_TRUE;
    features.scalarBlockLayout = VK_TRUE;
    features.hostQueryReset = VK_TRUE;
    VkDeviceCreateInfo create{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features};
    create.queueCreateInfoCount = 1;
    create.pQueueCreateInfos = &queue;
    VkDevice device = VK_NULL_HANDLE;
    check(vkCreateDevice(chosen.handle, &create, nullptr, &device), "opening the device");
    return device;
}

} // namespace

Device::Device(const std::string& wish, Validation validation)
    : instance_(foundForEngine([&] { return Instance(validation); })),
      chosen_(foundForEngine([&] { return instance_.choose(wish); })), device_(makeDevice(chosen_))
{
    vkGetDeviceQueue(device_, chosen_.queueFamily, 0, &queue_);

    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = chosen_.queueFamily;
    check(vkCreateCommandPool(device_, &pool, nullptr, &commandPool_), "opening the device");

    const VkPushConstantRange arguments{VK_SHADER_STAGE_COMPUTE_BIT, 0, kArgumentBytes};
    VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &arguments;
    check(vkCreatePipelineLayout(device_, &layout, nullptr, &pipelineLayout_),
          "opening the device");
}

Device::~Device()
{
    vkDestroyPipelineLayout(device_, pipelineLayout_, nullptr);
    vkDestroyCommandPool(device_, commandPool_, nullptr);
    vkDestroyDevice(device_, nullptr);
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
