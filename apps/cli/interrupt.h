#pragma once

#include "relamp/progress.h"

#include <atomic>
#include <thread>

/// Turns Ctrl-C (and a polite kill) into Progress::cancel while it lives.
///
/// What does not end within the second that a person waits is cut off: half-written files are
/// removed and the process ends. Make it before any other thread, so that the signals come here.
/// What came too late for this computation is there for the next: of several scans none begins.
class Interrupt
{
public:
    explicit Interrupt(relamp::Progress& progress);
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    static constexpr int kExitCode = 130;

private:
    void watch();

    relamp::Progress& progress_;
    std::atomic<bool> done_{false};
    bool isAsked_ = false; // the watcher's
    std::thread watcher_;
};
