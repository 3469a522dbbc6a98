#pragma once

#include "relamp/api.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace relamp
{

/// Where a long computation stands. One object serves one computation; a second thread may cancel
/// it.
class RELAMP_API Progress
{
public:
    struct Event
    {
        std::string_view stage; // name of the stage, as in the report
        double fraction;        // of that stage, 0..1
        std::string_view part;  // that it works on, "frame 3 of 192"; empty: the whole
    };
    struct StageTime
    {
        std::string stage;
        double seconds;
    };
    /// Called from any thread, one call at a time.
    using Sink = std::function<void(const Event&)>;

    explicit Progress(Sink sink = {}) : sink_(std::move(sink)) {}

    /// Asks the computation to stop. It throws Error(cancelled) at its next step. Signal safe.
    void cancel() { cancelled_.store(true, std::memory_order_relaxed); }

    /// Throws Error(cancelled) once cancel() was called.
    void check() const;

    /// Names a file or folder that means nothing unless the computation ends well.
    void removeIfAbandoned(const std::filesystem::path& path);
    /// Removes these, for a process that has to end without waiting for the computation.
    void abandon();

    /// Says which part of the whole all stages from here on work on: "frame 3 of 192", or nothing.
    void setPart(std::string part);

    /// Seconds spent in each stage that has ended, in the order of their first end; a stage that
    /// ran several times is listed once, with the sum. No second counts twice: while a stage runs
    /// within another, the time is its own.
    [[nodiscard]] std::vector<StageTime> times() const;

    /// Seconds since this object was made.
    [[nodiscard]] double elapsed() const;

    /// A stage lasts as long as this object. Its steps may be counted by several threads; stages
    /// themselves begin and end like brackets, on one thread.
    class RELAMP_API Stage
    {
    public:
        Stage(Progress& progress, std::string_view name, size_t steps = 1);
        ~Stage();
        Stage(const Stage&) = delete;
        Stage& operator=(const Stage&) = delete;

        /// Counts `steps` as done. Throws Error(cancelled) as Progress::check does.
        void advance(size_t steps = 1);

    private:
        Progress& progress_;
        std::string name_;
        size_t steps_;
        std::atomic<size_t> done_{0};
        std::chrono::steady_clock::time_point start_;
        Stage* outer_;
        double secondsOfInner_ = 0.0;
    };

private:
    void report(std::string_view stage, double fraction);
    void ended(const std::string& stage, double seconds);

    Sink sink_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    Stage* innermost_ = nullptr;
    std::atomic<bool> cancelled_{false};
    mutable std::mutex mutex_;
    std::vector<StageTime> times_;
    std::vector<std::filesystem::path> unfinished_;
    std::string part_;
};

/// What a function gets by default that can be watched: a Progress of this one call, which nobody
/// watches. It lives as long as the call.
inline Progress& unwatched(Progress&& ofThisCall = Progress())
{
    return ofThisCall;
}

} // namespace relamp
