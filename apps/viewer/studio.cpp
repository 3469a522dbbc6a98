#include "studio.h"

#include "relamp/error.h"

#include <algorithm>
#include <utility>

namespace
{

constexpr size_t kMessages = 6;

} // namespace

Studio::Studio(RoomDrawing& drawing, const relamp::EngineOptions& engine,
               const std::function<void()>& wake)
    : drawing_(drawing), engine_(engine), mailbox_(wake), history_(edit),
      light_(drawing, mailbox_, engine,
             {.failed = [this](const std::string& sentence) { fail(sentence); }, .changed = wake}),
      solver_(wake,
              [this](const std::string& sentence) {
                  mailbox_.post([this, sentence] { fail(sentence); });
              }),
      saver_(wake, [this](const std::string& sentence) {
          mailbox_.post([this, sentence] { fail(sentence); });
      })
{}

void Studio::say(const std::string& sentence)
{
    messages.push_back(sentence);
    if (messages.size() > kMessages) messages.pop_front();
}

/// What is to be said of a solution, each once.
void Studio::tell(const std::vector<std::string>& notes)
{
    for (const std::string& note : notes)
        if (std::find(room_.notes.begin(), room_.notes.end(), note) == room_.notes.end()) say(note);
    room_.notes = notes;
}

void Studio::fail(const std::string& sentence)
{
    hasFailed_ = true;
    ++failures_;
    reevaluating_.reset();
    say(sentence);
}

void Studio::commit(const std::string& step)
{
    if (edit == applied_) return;
    if (edit.scanned != applied_.scanned)
        followSky(edit.light, skyUnder(applied_.scanned, room_.found),
                  skyUnder(edit.scanned, room_.found));
    history_.record(edit, step);
    const Edit before = applied_;
    apply(before);
}

void Studio::undo()
{
    if (!history_.canUndo()) return say("There is nothing to undo.");
    const Edit before = applied_;
    edit = history_.undo();
    apply(before);
}

void Studio::redo()
{
    if (!history_.canRedo()) return say("There is nothing to redo.");
    const Edit before = applied_;
    edit = history_.redo();
    apply(before);
}

void Studio::apply(const Edit& before)
{
    const bool isLightNew = !(edit.light == before.light);
    edit.light.fixtures.resize(room_.captured.fixtures.size());
    edit.scanned.fixtures.resize(room_.captured.fixtures.size(), kAsFound);
    applied_ = edit;
    if (isLightNew) {
        room_.isLightOfScan = edit.light == documentOf(skyUnder(edit.scanned, room_.found));
        play(false);
        if (selection.kind == Selection::Kind::lamp && selection.index >= edit.light.lamps.size())
            selection = {};
        sendLight();
    }
    follow(before);
}

/// Computes again what the parameters and the light of the day of the scan decide, and no more.
void Studio::follow(const Edit& before)
{
    SolverParameters parameters = before.parameters;
    const bool isScannedNew = edit.scanned != before.scanned;
    const bool isDivisionNew =
        edit.parameters.albedo != std::exchange(parameters.albedo, edit.parameters.albedo);
    if (edit.parameters != parameters || (isDivisionNew && !canReevaluate())) return solveAgain();
    if (!isScannedNew && !isDivisionNew) return;
    if (canReevaluate()) return reevaluate();
    if (room_.stage == Stage::solved && edit.parameters.solver == relamp::Solver::gather)
        return solveAgain(); // a folder, of which no more is kept than its pictures
    if (room_.stage == Stage::solved)
        say("Only the solver Gather follows what is said of lamps on the day of the scan.");
}

/// The light of `edit`.
void Studio::sendLight()
{
    std::vector<std::string> notes;
    try {
        light_.shine(
            lightingOf(edit.light, room_.lightsFolder, room_.captured, notes, room_.reader));
    } catch (const relamp::Error& error) {
        say(error.what()); // as by a picture of the sky that is gone
    }
}

bool Studio::rests() const
{
    return !opening_ && !solver_.status().isBusy && !saver_.status().isBusy &&
           light_.status().stage.empty() && (!drawing_.has(Layer::albedo) || light_.isRelit());
}
