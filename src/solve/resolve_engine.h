#pragma once

#include "albedo/page_layers.h"
#include "gpu/twin.h"
#include "relamp/devices.h"
#include "scan/texels.h"
#include "solve/resolve.h"
#include "solve/resolve_gpu.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace relamp
{

/// What gives a solved room other powers: the CPU or a GPU, as the options say. Both give the same,
/// within what resolve_engine_test.cpp says. It hands over as gpu::Twin does.
class ResolveEngine : public std::enable_shared_from_this<ResolveEngine>
{
public:
    /// `texels` must outlive this. Of `room` what no power changes is taken, when it is first
    /// resolved; later calls are of the same one. Throws Error(device) where a GPU is asked for and
    /// there is none.
    ResolveEngine(const Texels& texels, const EngineOptions& options);

    /// As resolve(). What makes the layers of its pages then, as makeLayers(): that outlives the
    /// call, is thread safe, and stays as it is whatever is resolved later. Null: the CPU.
    DeviceLayers resolve(SolvedRoom& room, const LampPowers& powers);

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
    const SolvedRoom* room_ = nullptr; // while it is resolved
    mutable std::mutex mutex_;
    gpu::Twin<ResolveGpu> gpu_;
    std::shared_ptr<const Asked> lit_; // what the device shades by; null: nothing yet
};

} // namespace relamp
