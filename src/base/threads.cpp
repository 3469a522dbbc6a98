#include "relamp/threads.h"

#include <thread>

#include <OpenImageIO/imageio.h>
#include <tbb/global_control.h>

namespace relamp
{

struct ThreadLimit::Control
{
    tbb::global_control control;
};

ThreadLimit::ThreadLimit(int count)
{
    const size_t threads =
        count > 0 ? static_cast<size_t>(count) : std::thread::hardware_concurrency();
    control_ = std::make_unique<Control>(
        Control{tbb::global_control(tbb::global_control::max_allowed_parallelism, threads)});
    OIIO::attribute("threads", static_cast<int>(threads));
    OIIO::attribute("exr_threads", static_cast<int>(threads));
}

ThreadLimit::~ThreadLimit() = default;

} // namespace relamp
