#pragma once

#include "input.h"
#include "script.h"

#include <chrono>
#include <ctime>
#include <deque>
#include <filesystem>
#include <functional>
#include <random>
#include <vector>

class Viewer;

/// Drives a viewer by a script: one command after the other, an event a frame.
class ScriptRunner
{
public:
    using Send = std::function<void(const InputEvent&)>;

    ScriptRunner(std::vector<ScriptCommand> commands, std::filesystem::path file);

    /// Goes on as far as it can before the next frame. False at the end of the script. Throws
    /// relamp::Error naming the file and the line where a command fails, or waits too long.
    bool step(Viewer& viewer, const Send& send);
    /// Whether the viewer is a person's when the script has ended; else it ends, too.
    [[nodiscard]] bool stays() const;
    /// False while it waits for what the threads are at.
    [[nodiscard]] bool needsFrames() const;

private:
    using Clock = std::chrono::steady_clock;

    bool advance(Viewer& viewer);
    void begin(const ScriptCommand& command, Viewer& viewer);
    [[nodiscard]] bool isDone(const ScriptCommand& command, Viewer& viewer) const;
    void end(const ScriptCommand& command, Viewer& viewer);
    [[nodiscard]] bool isThere(const std::string& what, const Viewer& viewer) const;
    void addKey(const std::string& name, bool release);
    void addDrag(const ScriptCommand& command);
    void addClick(const ScriptCommand& command);
    InputEvent randomEvent(const Viewer& viewer);

    std::vector<ScriptCommand> commands_;
    std::filesystem::path file_;
    size_t at_ = 0;
    bool hasBegun_ = false;
    size_t failuresBefore_ = 0; // what is waited for
    bool mustOpen_ = false;     // what was there before is not what is waited for
    Clock::time_point start_;
    size_t firstFrame_ = 0;
    std::clock_t firstClock_ = 0; // of the processor, all threads
    std::deque<InputEvent> events_;
    std::mt19937 random_;
    double seconds_ = 0.0; // that the command takes
};
