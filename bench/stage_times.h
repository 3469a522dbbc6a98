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

/// A stage, in seconds.
struct StageTime
{
    std::string stage;
    double gpu = 0.0;   // by the device's clock; 0 where there is none
    double floor = 0.0; // least that the device could take: bytes or operations; 0: not known
    double cpu = 0.0;
};

struct StageTimes
{
    size_t texels = 0;
    std::vector<StageTime> stages;

    [[nodiscard]] RELAMP_API StageTime total() const;
};

/// One frame of the thesis, as Choi's table 1: a scan's light taken out, from texture to albedo.
/// Reading, rasterising and finding the lights come before it.
struct FrameTimes : StageTimes
{
    size_t lights = 0;
    size_t shadowMaps = 0;
};

/// The gather solver after the power of a lamp changed, from powers to finished layers. Finding the
/// lamps, rays and shadows come before it, and what is said of surfels.
struct ReevaluateTimes : StageTimes
{
    size_t lamps = 0; // the sun is one
    size_t surfels = 0;
    size_t rays = 0;   // that were cast and are kept
    double once = 0.0; // what the GPU takes for what it keeps of lamps on texels, before
};

struct BenchReport
{
    std::string gpu;             // empty: none
    double bytesPerSecond = 0.0; // that the GPU copies, measured
    double flopsPerSecond = 0.0; // of its multiply-adds, measured
    std::string cpu;
    FrameTimes frame;
    ReevaluateTimes reevaluate;
};

/// Throws Error(device) where a GPU is asked for that is not there, Error(unsupported) where
/// delight() would.
RELAMP_API BenchReport measureStages(const Scan& scan, const BenchOptions& options,
                                     Progress& progress = unwatched());

} // namespace relamp
