#include "script_runner.h"

#include "actions.h"
#include "script_set.h"
#include "viewer.h"

#include "relamp/error.h"

#include <algorithm>
#include <cstdio>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

namespace
{

constexpr double kLongestWait = 600.0; // s

[[noreturn]] void wrongCommand(const std::string& sentence)
{
    throw relamp::Error(relamp::ErrorCode::malformed, sentence);
}

/// With what the viewer told last.
[[noreturn]] void failAs(const Viewer& viewer)
{
    wrongCommand(viewer.studio.messages.empty() ? "it failed" : viewer.studio.messages.back());
}

int buttonOf(const ScriptCommand& command, size_t word)
{
    if (command.words.size() <= word || command.words[word] == "left")
        return GLFW_MOUSE_BUTTON_LEFT;
    if (command.words[word] == "right") return GLFW_MOUSE_BUTTON_RIGHT;
    if (command.words[word] == "middle") return GLFW_MOUSE_BUTTON_MIDDLE;
    wrongCommand(
        fmt::format("\"{}\" is no button; there are left, right and middle", command.words[word]));
}

glm::vec2 placeOf(const ScriptCommand& command, size_t word)
{
    return {numberOf(command.words[word]), numberOf(command.words[word + 1])};
}

InputEvent moveTo(glm::vec2 at)
{
    return {.kind = InputEvent::Kind::move, .at = at};
}

InputEvent button(int code, bool down)
{
    return {.kind = InputEvent::Kind::button, .code = code, .down = down};
}

KeyChord chordOf(const std::string& name)
{
    const std::optional<KeyChord> chord = chordNamed(name);
    if (!chord) wrongCommand(fmt::format("\"{}\" is no key", name));
    return *chord;
}

bool takesTime(const ScriptCommand& command)
{
    return command.name == "hold" || command.name == "measure" || command.name == "random";
}

} // namespace

ScriptRunner::ScriptRunner(std::vector<ScriptCommand> commands, std::filesystem::path file)
    : commands_(std::move(commands)), file_(std::move(file))
{}

bool ScriptRunner::step(Viewer& viewer, const Send& send)
{
    if (events_.empty()) {
        try {
            while (events_.empty() && advance(viewer)) {
            }
            if (at_ >= commands_.size() && viewer.studio.failures() > failuresBefore_)
                failAs(viewer);
        } catch (const relamp::Error& error) {
            const size_t line =
                commands_.empty() ? 0 : commands_[std::min(at_, commands_.size() - 1)].line;
            throw relamp::Error(error.code(),
                                fmt::format("{} line {}: {}", file_.string(), line, error.what()));
        }
    }
    if (!events_.empty()) {
        const InputEvent event = events_.front();
        events_.pop_front();
        send(event);
    }
    return at_ < commands_.size() || !events_.empty();
}

bool ScriptRunner::needsFrames() const
{
    return !events_.empty() || (at_ < commands_.size() && commands_[at_].name != "wait");
}

bool ScriptRunner::stays() const
{
    return !commands_.empty() && commands_.back().name == "stay";
}

/// Begins, ends or goes on with a command; false where a frame has to pass.
bool ScriptRunner::advance(Viewer& viewer)
{
    if (at_ >= commands_.size()) return false;
    const ScriptCommand& command = commands_[at_];
    if (!hasBegun_) {
        hasBegun_ = true;
        start_ = Clock::now();
        firstFrame_ = viewer.framesDrawn();
        firstClock_ = std::clock();
        begin(command, viewer);
        return false; // what it did is seen in the next frame
    }
    if (command.name == "random" && !isDone(command, viewer))
        events_.push_back(randomEvent(viewer));
    if (command.name == "measure") viewer.studio.camera.turn({0.02f, 0.0f});
    if (!isDone(command, viewer)) return false;
    end(command, viewer);
    hasBegun_ = false;
    ++at_;
    return true;
}

void ScriptRunner::begin(const ScriptCommand& command, Viewer& viewer)
{
    const std::string& name = command.name;
    const std::vector<std::string>& words = command.words;
    if (name != "wait") failuresBefore_ = viewer.studio.failures();
    seconds_ = takesTime(command) ? numberOf(words[name == "hold" ? 1 : 0]) : 0.0;
    if (name == "open") viewer.studio.open(words[0], {});
    if (name == "open" || name == "drop") mustOpen_ = name == "open";
    if (name == "press") addKey(words[0], true);
    if (name == "hold") addKey(words[0], false);
    if (name == "click") addClick(command);
    if (name == "drag") addDrag(command);
    if (name == "move") events_.push_back(moveTo(placeOf(command, 0)));
    if (name == "scroll")
        events_.push_back({.kind = InputEvent::Kind::scroll, .at = {0.0f, numberOf(words[0])}});
    if (name == "type") events_.push_back({.kind = InputEvent::Kind::text, .text = words[0]});
    if (name == "drop") events_.push_back({.kind = InputEvent::Kind::drop, .text = words[0]});
    if (name == "size")
        viewer.window().resize(
            {static_cast<int>(numberOf(words[0])), static_cast<int>(numberOf(words[1]))});
    if (name == "set") setByScript(viewer, words);
    if (name == "do") runAction(words[0], viewer);
    if (name == "save" && words[0] == "lights") viewer.studio.saveLights(words[1]);
    if (name == "save" && words[0] == "result") viewer.studio.saveResult(words[1]);
    if (name == "save" && words[0] == "baked") viewer.studio.saveBaked(words[1]);
    if (name == "save" && words[0] == "page") viewer.studio.savePage(words[1]);
    if (name == "random") random_.seed(static_cast<unsigned>(numberOf(words[1])));
    if (name == "quit") viewer.quit();
}

bool ScriptRunner::isDone(const ScriptCommand& command, Viewer& viewer) const
{
    const double passed = std::chrono::duration<double>(Clock::now() - start_).count();
    if (takesTime(command)) return passed >= seconds_;
    if (command.name != "wait") return events_.empty();
    const std::string& what = command.words[0];
    if (what.find_first_not_of("0123456789.") == std::string::npos) return passed >= numberOf(what);
    const bool isStillThere = mustOpen_ && viewer.studio.hasFailed(); // what was open before
    if (!isStillThere && isThere(what, viewer)) return true;
    if (isStillThere || viewer.studio.failures() > failuresBefore_) failAs(viewer);
    if (passed > kLongestWait)
        wrongCommand(fmt::format("{} did not come in {} s", what, kLongestWait));
    return false;
}

bool ScriptRunner::isThere(const std::string& what, const Viewer& viewer) const
{
    const Stage stage = viewer.studio.stage();
    if (what == "scan") return stage >= Stage::scanned;
    if (what == "draft") return stage >= Stage::drafted;
    if (what == "solve") return stage == Stage::solved && !viewer.studio.reevaluates();
    if (what == "glance") return viewer.studio.light().isGlanced();
    if (what == "relit") return viewer.studio.light().isRelit();
    if (what == "rest") return viewer.studio.rests();
    wrongCommand(
        fmt::format("\"{}\" never comes; one can wait for scan, draft, solve, glance, relit, rest "
                    "or a number of seconds",
                    what));
}

void ScriptRunner::end(const ScriptCommand& command, Viewer& viewer)
{
    if (command.name == "hold") {
        const KeyChord chord = chordOf(command.words[0]);
        events_.push_back({.kind = InputEvent::Kind::key, .code = chord.key});
    }
    if (command.name == "screenshot") viewer.screenshot(command.words[0], command.words.size() > 1);
    if (command.name == "measure") {
        const double passed = std::chrono::duration<double>(Clock::now() - start_).count();
        const auto frames = static_cast<double>(viewer.framesDrawn() - firstFrame_);
        const double busy = static_cast<double>(std::clock() - firstClock_) / CLOCKS_PER_SEC;
        fmt::print("{:.1f} frames/s, {:.1f} ms of the processor's cores a frame\n", frames / passed,
                   1000.0 * busy / std::max(frames, 1.0));
        if (viewer.studio.light().isGlanced())
            fmt::print("{:.0f} ms for the last glance at the light\n",
                       viewer.studio.light().glanceMilliseconds());
        if (const auto milliseconds = viewer.studio.reevaluateMilliseconds())
            fmt::print("{:.0f} ms until the albedo followed a lamp of the scan\n", *milliseconds);
        std::fflush(stdout);
    }
}

void ScriptRunner::addKey(const std::string& name, bool release)
{
    const KeyChord chord = chordOf(name);
    InputEvent event{
        .kind = InputEvent::Kind::key, .code = chord.key, .down = true, .mods = chord.mods};
    events_.push_back(event);
    if (!release) return;
    event.down = false;
    event.mods = 0;
    events_.push_back(event);
}

void ScriptRunner::addClick(const ScriptCommand& command)
{
    const int code = buttonOf(command, 2);
    const glm::vec2 at = placeOf(command, 0);
    events_.insert(events_.end(),
                   {moveTo(at), moveTo(at), button(code, true), button(code, false)});
}

void ScriptRunner::addDrag(const ScriptCommand& command)
{
    constexpr int kSteps = 12;
    const int code = buttonOf(command, 4);
    const glm::vec2 from = placeOf(command, 0);
    const glm::vec2 to = placeOf(command, 2);
    events_.insert(events_.end(), {moveTo(from), moveTo(from), button(code, true)});
    for (int i = 1; i <= kSteps; ++i)
        events_.push_back(moveTo(from + static_cast<float>(i) / kSteps * (to - from)));
    events_.push_back(button(code, false));
}

InputEvent ScriptRunner::randomEvent(const Viewer& viewer)
{
    const auto below = [&](int most) {
        return static_cast<int>(random_() % static_cast<unsigned>(most));
    };
    const glm::vec2 size = viewer.eye().pixels + glm::vec2(viewer.frame().offset.x, 0);
    const glm::vec2 at(static_cast<float>(below(static_cast<int>(size.x) + 20)),
                       static_cast<float>(below(static_cast<int>(size.y) + 40)));
    switch (below(8)) {
    case 0:
    case 1:
        return button(below(3), below(2) == 0);
    case 2: {
        // Every key that does something, but those that write files or end the program.
        const std::span<const Action> all = actions();
        const Action& action = all[static_cast<size_t>(below(static_cast<int>(all.size())))];
        const std::string name = action.name;
        const std::optional<KeyChord> chord = chordNamed(action.key);
        if (!chord || name == "quit" || name == "picture" || name.starts_with("save"))
            return moveTo(at);
        return {.kind = InputEvent::Kind::key,
                .code = chord->key,
                .down = below(3) != 0,
                .mods = chord->mods};
    }
    case 3:
        return {.kind = InputEvent::Kind::key,
                .code = GLFW_KEY_RIGHT + below(4),
                .down = below(2) == 0};
    case 4:
        return {.kind = InputEvent::Kind::scroll, .at = {0.0f, static_cast<float>(below(7) - 3)}};
    case 5:
        return {.kind = InputEvent::Kind::text,
                .text = std::string(1, static_cast<char>('0' + below(10)))};
    default:
        return moveTo(at);
    }
}
