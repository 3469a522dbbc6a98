#pragma once

#include "gpu/vulkan.h"
#include "relamp/devices.h"

#include <string>
#include <vector>

namespace relamp::gpu
{

/// Whether Vulkan's validation layer looks over every call: for tests.
enum class Validation { off, on };

/// A connection to the machine's Vulkan drivers.
class Instance
{
public:
    /// Throws Error(device) where there is no loader, no driver, or no layer that was asked for.
    explicit Instance(Validation validation = Validation::off);
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    [[nodiscard]] VkInstance handle() const { return instance_; }

    struct Candidate
    {
        VkPhysicalDevice handle = VK_NULL_HANDLE;
        uint32_t queueFamily = 0; // that computes
        GpuDevice description;
    };
    /// Devices that can do what the programs ask for.
    [[nodiscard]] std::vector<Candidate> candidates() const;
    /// The one that `wish` names, by index or a part of its name, or else the best: a real one
    /// before a software one, then by memory. Throws Error(device) where there is none.
    [[nodiscard]] Candidate choose(const std::string& wish) const;

    /// What the validation layer had to say so far.
    [[nodiscard]] const std::vector<std::string>& complaints() const { return complaints_; }

private:
    void listen();
    /// volk's pointers are of the instance made last, which need not have the extension.
    template<class Function>
    [[nodiscard]] Function extension(const char* name) const
    {
        return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance_, name));
    }

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    std::vector<std::string> complaints_;
};

} // namespace relamp::gpu
