#include "machine.h"

#include "base/instruction_set.h"
#include "base/parallel.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <thread>
#include <vector>

namespace relamp::bench
{
namespace
{

constexpr size_t kCopied = size_t{64} << 20; // bytes a buffer, beyond the last-level cache
constexpr int kRounds = 5;
constexpr size_t kFmaLoops = 2'000'000;
constexpr size_t kAccumulators = 192; // twelve chains of sixteen lanes: enough to hide the latency

double best(const std::function<void()>& work)
{
    double least = 1e9;
    for (int round = 0; round < kRounds; ++round) {
        const auto start = std::chrono::steady_clock::now();
        work();
        least = std::min(
            least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return least;
}

void fmaKernel(float (&sum)[kAccumulators])
{
    for (size_t i = 0; i < kFmaLoops; ++i)
        for (size_t k = 0; k < kAccumulators; ++k) sum[k] = sum[k] * 0.999f + 0.001f;
}

Machine measure()
{
    const size_t threads = std::thread::hardware_concurrency();
    std::vector<char> from(kCopied, 1);
    std::vector<char> to(kCopied, 2);
    const double copy = best([&] {
        forEachChunk(kCopied, size_t{1} << 20, [&](size_t begin, size_t end) {
            std::memcpy(&to[begin], &from[begin], end - begin);
        });
    });
    std::vector<float> kept(threads * kAccumulators);
    const double fma = best([&] {
        forEach(threads, [&](size_t t) {
            float sum[kAccumulators] = {};
            runKernel<fmaKernel>(bestInstructionSet(), sum);
            std::copy(std::begin(sum), std::end(sum), &kept[t * kAccumulators]);
        });
    });
    const double flops = 2.0 * static_cast<double>(threads * kFmaLoops * kAccumulators);
    return {2.0 * static_cast<double>(kCopied) / copy, flops / fma};
}

} // namespace

const Machine& machine()
{
    static const Machine measured = measure();
    return measured;
}

double floorSeconds(double bytes, double flops)
{
    return std::max(bytes / machine().bytesPerSecond, flops / machine().flopsPerSecond);
}

} // namespace relamp::bench
