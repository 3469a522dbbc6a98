#include "gpu/peak.h"

#include "gpu/commands.h"
#include "gpu/peak.comp.h"
#include "gpu/peak.gpu.h"

#include <algorithm>

namespace relamp::gpu
{
namespace
{

constexpr int kRounds = 5;

/// Seconds of the fastest of some runs.
template<class Record>
double fastest(const Device& device, const Record& record)
{
    double least = 1e9;
    for (int round = 0; round < kRounds; ++round) {
        Commands commands(device);
        commands.mark("work");
        record(commands);
        commands.run();
        least = std::min(least, commands.timings()[0].seconds);
    }
    return least;
}

} // namespace

double Peak::floorSeconds(double bytes, double flops) const
{
    return std::max(bytes / bytesPerSecond, flops / flopsPerSecond);
}

Peak measurePeak(const Device& device)
{
    const bool isReal = device.description().isReal();
    const size_t bytes = size_t{isReal ? 512u : 64u} << 20;
    const Array<std::byte> from(device, bytes);
    const Array<std::byte> to(device, bytes);
    const double copy = fastest(device, [&](Commands& commands) {
        commands.copy(from.buffer(), 0, to.buffer(), 0, bytes);
    });

    const size_t threads = size_t{1} << (isReal ? 20 : 14);
    constexpr uint32_t kLoops = 1024;
    const Array<glm::vec4> sums(device, threads);
    const Program program(device, kPeakSpirv);
    const double compute = fastest(device, [&](Commands& commands) {
        commands.dispatch(program, threads, PeakArguments{sums.ref(), kLoops});
    });
    const double flops = 2.0 * 4.0 * kPeakChains * kLoops * static_cast<double>(threads);
    return {2.0 * static_cast<double>(bytes) / copy, flops / compute};
}

} // namespace relamp::gpu
