#pragma once

#include "gpu/instance.h"
#include "gpu/owned.h"
#include "gpu/vulkan.h"
#include "relamp/api.h"
#include "relamp/devices.h"

#include <memory>
#include <span>
#include <string>

namespace relamp::gpu
{

/// A device with one queue. Not thread safe: one thread at a time works with it and with what was
/// made from it, and all of that goes before it does.
class RELAMP_API Device
{
public:
    /// One that computes. `wish` as EngineOptions::gpu. Throws Error(device).
    explicit Device(const std::string& wish = {}, Validation validation = Validation::off);
    /// One of `instance`, with `extensions` and the `features` of a chain of Vulkan's structs.
    Device(std::shared_ptr<const Instance> instance, Instance::Candidate chosen,
           const void* features, std::span<const char* const> extensions);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] const GpuDevice& description() const { return chosen_.description; }
    [[nodiscard]] const Instance& instance() const { return *instance_; }
    /// Bytes that the driver takes in one piece.
    [[nodiscard]] uint64_t largestAllocation() const;
    /// Until all that it was told to do is done.
    void wait() const;

    [[nodiscard]] VkDevice handle() const { return device_.get(); }
    [[nodiscard]] VkPhysicalDevice physical() const { return chosen_.handle; }
    [[nodiscard]] VkQueue queue() const { return queue_; }
    [[nodiscard]] uint32_t queueFamily() const { return chosen_.queueFamily; }
    [[nodiscard]] VkCommandPool commandPool() const { return commandPool_.get(); }
    /// Of every program: nothing but kArgumentBytes of push constants.
    [[nodiscard]] VkPipelineLayout pipelineLayout() const { return pipelineLayout_.get(); }

    static constexpr uint32_t kArgumentBytes = 128; // the least that Vulkan promises

private:
    Device(const std::shared_ptr<const Instance>& instance, const std::string& wish);
    struct Close
    {
        void operator()(VkDevice device) const;
    };

    std::shared_ptr<const Instance> instance_;
    Instance::Candidate chosen_;
    std::unique_ptr<VkDevice_T, Close> device_;
    VkQueue queue_ = VK_NULL_HANDLE;
    Owned<VkCommandPool> commandPool_;
    Owned<VkPipelineLayout> pipelineLayout_;
};

/// The device that `options` ask for, null for the CPU: where they do, and where they leave it open
/// and there is none but in software. Throws Error(device) where one is asked for and not there.
std::unique_ptr<Device> deviceFor(const EngineOptions& options);

} // namespace relamp::gpu
