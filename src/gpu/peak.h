#pragma once

#include "gpu/device.h"

namespace relamp::gpu
{

/// What a device can do at best, measured: the floor under every stage's time.
struct Peak
{
    double bytesPerSecond = 0.0; // read and written by a copy beyond its caches
    double flopsPerSecond = 0.0; // multiply-adds, two each

    /// Least seconds for work that moves `bytes` and computes `flops`, whichever takes longer.
    [[nodiscard]] double floorSeconds(double bytes, double flops) const;
};
Peak measurePeak(const Device& device);

} // namespace relamp::gpu
