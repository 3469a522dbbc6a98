#include "relamp/threads.h"

#include <algorithm>
#include <thread>

#include <OpenEXR/ImfThreading.h>
#include <tbb/global_control.h>

namespace relamp
{

/// Stays where it is made: oneTBB forgets a limit as soon as a copy of it is gone.
struct ThreadLimit::Control
{
    explicit Control(size_t threads) : limit(tbb::global_control::max_allowed_parallelism, threads)
    {}

    tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int count)
{
    const size_t threads =
        count > 0 ? static_cast<size_t>(count) : std::thread::hardware_concurrency();
    control_ = std::make_unique<Control>(threads);
    constexpr size_t kMostExrThreads = 256; // image/other_formats.cpp comes with as many
    Imf::setGlobalThreadCount(static_cast<int>(std::min(threads, kMostExrThreads)));
}

ThreadLimit::~ThreadLimit() = default;

} // namespace relamp
