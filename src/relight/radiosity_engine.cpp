#include "relight/radiosity_engine.h"

#include <fmt/format.h>

namespace relamp
{

RadiosityEngine::RadiosityEngine(const Transport& transport, const EngineOptions& options)
    : transport_(transport), isFree_(options.engine == Engine::automatic && options.gpu.empty())
{
    try {
        device_ = gpu::deviceFor(options);
    } catch (const Error& error) {
        giveUp(error);
    }
}

RadiosityEngine::~RadiosityEngine() = default;

void RadiosityEngine::giveUp(const Error& error)
{
    if (!isFree_ || error.code() != ErrorCode::device) throw error;
    gpu_.reset();
    device_.reset();
    note_ = fmt::format("{}; the CPU took over", error.what());
}

Bounced RadiosityEngine::bounce(std::span<const glm::vec3> albedo,
                                std::span<const glm::vec3> direct, std::span<const glm::vec3> sky,
                                const KnownLight& known)
{
    if (!device_) return relamp::bounce(transport_, albedo, direct, sky, known);
    try {
        if (!gpu_) gpu_ = std::make_unique<RadiosityGpu>(*device_, transport_);
        return gpu_->bounce(albedo, direct, sky, known);
    } catch (const Error& error) {
        giveUp(error);
    }
    return relamp::bounce(transport_, albedo, direct, sky, known);
}

std::string RadiosityEngine::name() const
{
    return device_ ? device_->description().name : "cpu";
}

} // namespace relamp
