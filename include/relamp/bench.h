#pragma once

#include "relamp/api.h"
#include "relamp/devices.h"
#include "relamp/progress.h"
#include "relamp/scan.h"

#include <string>
#include <vector>

namespace relamp
{

struct BenchOptions
{
    EngineOptions engine; // automatic: the best device, in software where there is no other
    int rounds = 5;       // the best of which counts, >= 1
};

/// A row of Choi's table 1, in seconds.
struct StageTime
{
    std::string stage;
    double gpu = 0.0;   // by the device's clock; 0 where there is none
    double floor = 0.0; // least that the device could take: bytes or operations; 0: not known
    double cpu = 0.0;
};

/// One frame of the thesis: a scan's light taken out, from texture to albedo. Reading, rasterising
/// and finding the lights come before it.
struct BenchReport
{
    size_t texels = 0;
    size_t lights = 0;
    size_t shadowMaps = 0;
    std::string gpu;             // empty: none
    double bytesPerSecond = 0.0; // that the GPU copies, measured
    double flopsPerSecond = 0.0; // of its multiply-adds, measured
    std::string cpu;
    std::vector<StageTime> stages;

    [[nodiscard]] RELAMP_API StageTime total() const;
};

/// Throws Error(device) where a GPU is asked for that is not there, Error(unsupported) where
/// delight() would.
RELAMP_API BenchReport measureFrame(const Scan& scan, const BenchOptions& options,
                                    Progress& progress);

} // namespace relamp
