#include "relight/radiosity_engine.h"

#include <memory>

namespace relamp
{

RadiosityEngine::RadiosityEngine(const Transport& transport, const EngineOptions& options)
    : transport_(transport),
      gpu_(gpu::Choice::of(options), [&transport](const gpu::Device& device) {
          return std::make_unique<RadiosityGpu>(device, transport);
      })
{}

Bounced RadiosityEngine::bounce(std::span<const glm::vec3> albedo,
                                std::span<const glm::vec3> direct, std::span<const glm::vec3> sky,
                                const KnownLight& known)
{
    Bounced bounced;
    const auto onGpu = [&](RadiosityGpu& gpu) { bounced = gpu.bounce(albedo, direct, sky, known); };
    if (gpu_.compute(onGpu)) return bounced;
    return relamp::bounce(transport_, albedo, direct, sky, known);
}

} // namespace relamp
