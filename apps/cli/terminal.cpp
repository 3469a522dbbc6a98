#include "terminal.h"

#include <chrono>
#include <cstdio>
#include <memory>
#include <string_view>

#include <fmt/format.h>
#include <unistd.h>

namespace
{

using Clock = std::chrono::steady_clock;

constexpr int kBarWidth = 30;
constexpr auto kRedrawEvery = std::chrono::milliseconds(50);

/// Never throws: where nobody can be told, the work goes on.
void say(const std::string& text)
{
    std::fputs(text.c_str(), stderr);
}

bool isTerminal()
{
    return isatty(fileno(stderr)) != 0;
}

void drawBar(std::string_view stage, double fraction)
{
    const int done = static_cast<int>(fraction * kBarWidth);
    say(fmt::format("\r  {:<12} [{:<{}}] {:3.0f} %", stage,
                    std::string(static_cast<size_t>(done), '#'), kBarWidth, 100.0 * fraction));
    std::fflush(stderr);
}

} // namespace

relamp::Progress::Sink progressDisplay(Talk talk)
{
    if (talk == Talk::quiet) return {};
    struct State
    {
        std::string stage;
        Clock::time_point drawn;
    };
    const auto state = std::make_shared<State>();
    if (isTerminal())
        return [state](const relamp::Progress::Event& event) {
            const auto now = Clock::now();
            if (event.stage == state->stage && event.fraction < 1.0 &&
                now - state->drawn < kRedrawEvery)
                return;
            *state = {std::string(event.stage), now};
            drawBar(event.stage, event.fraction);
        };
    return [state](const relamp::Progress::Event& event) {
        if (event.stage == state->stage) return;
        state->stage = event.stage;
        say(fmt::format("  {} ...\n", event.stage));
    };
}

void endProgressDisplay(Talk talk)
{
    if (talk == Talk::normal && isTerminal()) say(fmt::format("\r{:60}\r", ""));
}

void printProblem(const std::string& sentence)
{
    std::string text = "relamp: " + sentence;
    for (size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1))
        text.insert(at + 1, "        ");
    say(text + "\n");
}
