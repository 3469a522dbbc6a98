#pragma once

#include "gpu/instance.h"
#include "gpu/vulkan.h"
#include "relamp/devices.h"

#include <memory>
#include <string>

namespace relamp::gpu
{

/// A device with one queue that computes. Not thread safe: one thread at a time works with it and
/// with what was made from it, and all of that goes before it does.
class Device
{
public:
    /// `wish` as EngineOptions::gpu. Throws Error(device).
    explicit Device(const std::string& wish = {}, Validation validation = Validation::off);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] const GpuDevice& description() const { return chosen_.description; }
    [[nodiscard]] const Instance& instance() const { return instance_; }

    [[nodiscard]] VkDevice handle() const { return device_; }
    [[nodiscard]] VkPhysicalDevice physical() const { return chosen_.handle; }
    [[nodiscard]] VkQueue queue() const { return queue_; }
    [[nodiscard]] uint32_t queueFamily() const { return chosen_.queueFamily; }
    [[nodiscard]] VkCommandPool commandPool() const { return commandPool_; }
    /// Of every program: nothing but kArgumentBytes of push constants.
    [[nodiscard]] VkPipelineLayout pipelineLayout() const { return pipelineLayout_; }

    static constexpr uint32_t kArgumentBytes = 128; // the least that Vulkan promises

private:
    Instance instance_;
    Instance::Candidate chosen_;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool commandPool_ = VK_NULL_HANDLE;
    VkPipelineLayout pipelineLayout_ = VK_NULL_HANDLE;
};

/// The device that `options` ask for, null for the CPU: where they do, and where they leave it open
/// and there is none but in software. Throws Error(device) where one is asked for and not there.
std::unique_ptr<Device> deviceFor(const EngineOptions& options);

} // namespace relamp::gpu
