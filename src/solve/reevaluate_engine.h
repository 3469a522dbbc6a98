#pragma once

#include "albedo/page_layers.h"
#include "gpu/twin.h"
#include "relamp/devices.h"
#include "scan/texels.h"
#include "solve/reevaluate.h"
#include "solve/reevaluate_gpu.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace relamp
{

/// What gives a solved room other powers: the CPU or a GPU, as the options say. Both give the same,
/// within what reevaluate_engine_test.cpp says. It hands over as gpu::Twin does.
class ReevaluateEngine : public std::enable_shared_from_this<ReevaluateEngine>
{
public:
    /// `texels` must outlive this. Of `room` what no power changes is taken, when it is first
    /// re-evaluated; later calls are of the same one. Throws Error(device) where a GPU is asked for
    /// and there is none.
    ReevaluateEngine(const Texels& texels, const EngineOptions& options);

    /// As reevaluate(). What makes the layers of its pages then, as makeLayers(): that outlives the
    /// call, is thread safe, and stays as it is whatever is re-evaluated later. Null: the CPU.
    DeviceLayers reevaluate(SolvedRoom& room, const LampPowers& powers);

    /// As gpu::Twin.
    [[nodiscard]] gpu::InForce inForce() const;

private:
    /// What the light of a room follows from.
    struct Asked
    {
        LampPowers powers;
        std::vector<uint8_t> shines;
    };

    bool settle(const SolvedRoom& room, const Asked& asked, SettledLight& light);
    std::optional<PageLayers> layersOf(const std::shared_ptr<const Asked>& asked, size_t page,
                                       const SolvedTexels& solved, const AlbedoOptions& options);

    const Texels& texels_;
    const SolvedRoom* room_ = nullptr; // while it is re-evaluated
    mutable std::mutex mutex_;
    gpu::Twin<ReevaluateGpu> gpu_;
    std::shared_ptr<const Asked> lit_; // what the device shades by; null: nothing yet
};

} // namespace relamp
