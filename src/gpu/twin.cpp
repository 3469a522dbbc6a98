#include "gpu/twin.h"

namespace relamp::gpu
{

std::string handedOver(const Error& error)
{
    return std::string(error.what()) + "; the CPU took over";
}

Choice Choice::of(const EngineOptions& options)
{
    Choice choice{.isFree = options.engine == Engine::automatic && options.gpu.empty()};
    try {
        choice.device = deviceFor(options);
    } catch (const Error& error) {
        if (!choice.isFree || error.code() != ErrorCode::device) throw;
        choice.note = handedOver(error);
    }
    return choice;
}

} // namespace relamp::gpu
