#include "terminal.h"

#include "progress_line.h"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string_view>

#include <sys/ioctl.h>
#include <unistd.h>

namespace
{

using Clock = std::chrono::steady_clock;

constexpr auto kRedrawEvery = std::chrono::milliseconds(50);
constexpr auto kTellEvery = std::chrono::seconds(1);

/// Never throws: where nobody can be told, the work goes on.
void say(const std::string& text)
{
    std::fputs(text.c_str(), stderr);
}

/// Whether somebody looks, at something that knows how to clear a line.
bool isTerminal()
{
    const char* kind = std::getenv("TERM");
    return isatty(fileno(stderr)) != 0 && (kind == nullptr || std::string_view(kind) != "dumb");
}

int columnsOfTerminal()
{
    winsize size{};
    return ioctl(fileno(stderr), TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

/// "bounce"; "frame 3 of 192, bounce".
std::string nameOf(const relamp::Progress::Event& event)
{
    return fmt::format("{}{}{}", event.part, event.part.empty() ? "" : ", ", event.stage);
}

struct Shown
{
    std::string name;
    Clock::time_point when;
};

/// A bar that is drawn over the one before.
void draw(const relamp::Progress::Event& event, Shown& shown)
{
    const auto now = Clock::now();
    const std::string name = nameOf(event);
    if (name == shown.name && event.fraction < 1.0 && now - shown.when < kRedrawEvery) return;
    shown = {name, now};
    say("\r" + progressLine(name, event.fraction, columnsOfTerminal()) + "\x1b[K");
    std::fflush(stderr);
}

/// A line for every stage; of parts, which may be thousands with all stages each, no more than one
/// a second.
void tell(const relamp::Progress::Event& event, Shown& shown)
{
    const std::string_view name = event.part.empty() ? event.stage : event.part;
    const auto now = Clock::now();
    if (name == shown.name || (!event.part.empty() && now - shown.when < kTellEvery)) return;
    shown = {std::string(name), event.part.empty() ? Clock::time_point() : now};
    say(fmt::format("  {}{}\n", name, event.part.empty() ? " ..." : ""));
}

/// A line for every stage and for every step of it, but no more than a bar is redrawn.
void count(const relamp::Progress::Event& event, Shown& shown)
{
    const auto now = Clock::now();
    const std::string name = nameOf(event);
    if (name == shown.name && event.fraction < 1.0 && now - shown.when < kRedrawEvery) return;
    shown = {name, now};
    say(fmt::format("  {} {:.0f} %\n", name, 100.0 * event.fraction));
}

} // namespace

relamp::Progress::Sink progressDisplay(Talk talk)
{
    if (talk == Talk::quiet) return {};
    const auto shown = std::make_shared<Shown>();
    const auto show = talk == Talk::lines ? count : isTerminal() ? draw : tell;
    return [shown, show](const relamp::Progress::Event& event) { show(event, *shown); };
}

void endProgressDisplay(Talk talk)
{
    if (talk == Talk::normal && isTerminal()) say("\r\x1b[K");
}

void printExactly(const std::string& text)
{
    std::fputs(text.c_str(), stdout);
}

void printAside(const std::string& raw)
{
    const std::string text = relamp::printableText(raw);
    size_t begin = 0;
    while (begin < text.size()) {
        const ssize_t written = write(STDOUT_FILENO, text.data() + begin,
                                      text.size() - begin); // no buffer to fail later
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return;
        begin += static_cast<size_t>(written);
    }
}

void printProblem(const std::string& sentence)
{
    std::string text = "relamp: " + relamp::printableText(sentence);
    for (size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1))
        text.insert(at + 1, "        ");
    say(text + "\n");
}
