#pragma once

#include "gpu/vulkan.h"
#include "relamp/api.h"
#include "relamp/devices.h"

#include <span>
#include <string>
#include <vector>

namespace relamp::gpu
{

/// Whether Vulkan's validation layer looks over every call: for tests.
enum class Validation { off, on };

/// A connection to the machine's Vulkan drivers.
class RELAMP_API Instance
{
public:
    /// `extensions` are what a window asks for. Throws Error(device) where there is no loader, no
    /// driver that has them, or no layer that was asked for.
    explicit Instance(Validation validation = Validation::off,
                      std::span<const char* const> extensions = {});
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    [[nodiscard]] VkInstance handle() const { return instance_; }

    struct Candidate
    {
        VkPhysicalDevice handle = VK_NULL_HANDLE;
        uint32_t queueFamily = 0; // that computes, or draws
        GpuDevice description;
    };
    /// Devices that can do what the programs ask for.
    [[nodiscard]] std::vector<Candidate> candidates() const;
    /// Devices that can draw in `window`, whatever else they can.
    [[nodiscard]] std::vector<Candidate> candidatesFor(VkSurfaceKHR window) const;
    /// Of `candidates`, which are some: a real one before a software one, then a graphics card,
    /// then by memory.
    [[nodiscard]] static Candidate best(const std::vector<Candidate>& candidates);
    /// The one that `wish` names, by index or a part of its name, or else the best. Throws
    /// Error(device) where there is none.
    [[nodiscard]] Candidate choose(const std::string& wish) const;

    /// What the validation layer had to say so far.
    [[nodiscard]] const std::vector<std::string>& complaints() const { return complaints_; }

private:
    void listen();
    [[nodiscard]] std::vector<VkPhysicalDevice> physicalDevices() const;

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    std::vector<std::string> complaints_;
};

} // namespace relamp::gpu
