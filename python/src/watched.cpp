#include "watched.h"

#include "relamp/threads.h"

#include <chrono>
#include <future>
#include <mutex>
#include <string>
#include <utility>

namespace
{

namespace py = pybind11;

/// The latest event that nobody has taken yet. Workers set it, Python takes it.
class LatestEvent
{
public:
    void set(const relamp::Progress::Event& event)
    {
        const std::scoped_lock lock(mutex_);
        latest_ = std::pair(std::string(event.stage), event.fraction);
    }
    std::optional<std::pair<std::string, double>> take()
    {
        const std::scoped_lock lock(mutex_);
        return std::exchange(latest_, std::nullopt);
    }

private:
    std::mutex mutex_;
    std::optional<std::pair<std::string, double>> latest_;
};

bool endsSoon(const std::future<void>& done)
{
    const py::gil_scoped_release others;
    return done.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
}

} // namespace

void runWatched(const py::object& watcher, int threads,
                const std::function<void(relamp::Progress&)>& work)
{
    LatestEvent latest;
    relamp::Progress progress(
        [&latest](const relamp::Progress::Event& event) { latest.set(event); });
    std::future<void> done = std::async(std::launch::async, [&] {
        const relamp::ThreadLimit limit(threads);
        work(progress);
    });
    try {
        while (!endsSoon(done)) {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            const auto event = latest.take();
            if (event && !watcher.is_none()) watcher(event->first, event->second);
        }
    } catch (...) {
        progress.cancel();
        const py::gil_scoped_release others;
        done.wait();
        throw;
    }
    done.get();
}
