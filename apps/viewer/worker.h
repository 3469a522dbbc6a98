#pragma once

#include "relamp/progress.h"

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

/// What a worker is at.
struct WorkStatus
{
    bool isBusy = false;
    std::string stage;
    double fraction = 0.0; // of that stage, 0..1
};

/// A thread that does one thing at a time: the newest that it was asked for.
class Worker
{
public:
    using Job = std::function<void(relamp::Progress&)>;

    /// `changed` is called when the status is another, `failed` with a sentence when a job throws
    /// anything but relamp::Error(cancelled); both from the worker's thread.
    Worker(std::function<void()> changed, std::function<void(const std::string&)> failed);
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// Cancels what it is at and forgets what waits, then does `job`.
    void start(Job job);
    void cancel();
    [[nodiscard]] WorkStatus status() const;

private:
    void work(const std::stop_token& stop);
    void run(const Job& job);
    void report(const relamp::Progress::Event& event);

    std::function<void()> changed_;
    std::function<void(const std::string&)> failed_;
    mutable std::mutex mutex_;
    std::condition_variable_any asked_;
    Job next_;
    std::shared_ptr<relamp::Progress> progress_; // of the job that runs
    WorkStatus status_;
    std::jthread thread_; // last: it uses all of these
};
