#pragma once

#include "relamp/api.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace relamp
{

/// A device that Vulkan knows and the GPU engine can work on.
struct GpuDevice
{
    enum class Type { discrete, integrated, virtualized, software, other };

    std::string name;
    Type type = Type::other;
    uint64_t memory = 0;          // bytes of its largest heap of its own
    std::string driver;           // name and version, as it tells them
    std::array<uint8_t, 16> id{}; // Vulkan's deviceUUID: the same device in another connection

    /// What computes on the processor is no help to an engine that already does.
    [[nodiscard]] bool isReal() const { return type != Type::software; }
};

/// All of them, in Vulkan's order; none where there is no loader or no driver.
RELAMP_API std::vector<GpuDevice> gpuDevices();

/// The one of them that `wish` names, as EngineOptions::gpu. Throws Error(device) where there is
/// none.
RELAMP_API GpuDevice gpuDevice(const std::string& wish);

/// The processor: threads and instruction set that the CPU engine uses.
RELAMP_API std::string cpuDevice();

/// What computes a stage.
enum class Engine {
    automatic, // the GPU if there is a real one and it can do the work, else the CPU
    cpu,
    gpu // Error(device) where there is none
};

struct EngineOptions
{
    Engine engine = Engine::automatic;
    std::string gpu; // index or a part of the name, as gpuDevices() tells them; empty: the best

    bool operator==(const EngineOptions&) const = default;
};

/// Throws Error(device) where the options ask for a GPU that is not there: to be told before long
/// work begins.
RELAMP_API void checkDevice(const EngineOptions& options);

} // namespace relamp
