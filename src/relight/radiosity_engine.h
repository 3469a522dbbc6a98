#pragma once

#include "gpu/device.h"
#include "relamp/devices.h"
#include "relamp/error.h"
#include "relight/radiosity.h"
#include "relight/radiosity_gpu.h"

#include <memory>
#include <span>
#include <string>

#include <glm/vec3.hpp>

namespace relamp
{

/// What follows bounces: the CPU or a GPU, as the options say. Both give the same, within what
/// radiosity_gpu_test.cpp says.
///
/// An engine that nobody asked for and that fails hands over to the CPU.
class RadiosityEngine
{
public:
    /// `transport` must outlive this. Throws Error(device) where a GPU is asked for and there is
    /// none.
    RadiosityEngine(const Transport& transport, const EngineOptions& options);
    ~RadiosityEngine();

    /// As the function of that name.
    Bounced bounce(std::span<const glm::vec3> albedo, std::span<const glm::vec3> direct,
                   std::span<const glm::vec3> sky, const KnownLight& known = {});

    /// "cpu", or the name of the GPU.
    [[nodiscard]] std::string name() const;
    /// A sentence where the CPU had to take over; else empty.
    [[nodiscard]] const std::string& note() const { return note_; }

private:
    void giveUp(const Error& error);

    const Transport& transport_;
    bool isFree_;                         // nobody asked for this engine
    std::unique_ptr<gpu::Device> device_; // null: the CPU
    std::unique_ptr<RadiosityGpu> gpu_;   // made with the first light
    std::string note_;
};

} // namespace relamp
