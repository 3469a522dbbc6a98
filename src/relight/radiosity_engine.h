#pragma once

#include "gpu/twin.h"
#include "relamp/devices.h"
#include "relight/radiosity.h"
#include "relight/radiosity_gpu.h"

#include <span>
#include <string>

#include <glm/vec3.hpp>

namespace relamp
{

/// What follows bounces: the CPU or a GPU, as the options say. Both give the same, within what
/// radiosity_gpu_test.cpp says. It hands over as gpu::Twin does.
class RadiosityEngine
{
public:
    /// `transport` must outlive this. Throws Error(device) where a GPU is asked for and there is
    /// none.
    RadiosityEngine(const Transport& transport, const EngineOptions& options);

    /// As the function of that name.
    Bounced bounce(std::span<const glm::vec3> albedo, std::span<const glm::vec3> direct,
                   std::span<const glm::vec3> sky, const KnownLight& known = {});

    /// As gpu::Twin.
    [[nodiscard]] std::string name() const { return gpu_.name(); }
    [[nodiscard]] const std::string& note() const { return gpu_.note(); }

private:
    const Transport& transport_;
    gpu::Twin<RadiosityGpu> gpu_;
};

} // namespace relamp
