#include "studio.h"

#include "relamp/error.h"

#include <algorithm>
#include <utility>

namespace
{

constexpr size_t kMessages = 6;

} // namespace

<<<<<<< HEAD
relamp::DelightOptions SolverParameters::options() const
{
    relamp::DelightOptions options;
    options.solver = solver;
    options.gather = gather;
    options.pathtrace = pathtrace;
    options.thesis = thesis;
    options.albedo = albedo;
    return options;
}

bool Edit::operator==(const Edit& other) const
{
    return light == other.light && scanned == other.scanned && parameters == other.parameters &&
           view.view == other.view.view && view.exposure == other.view.exposure;
}

=======
>>>>>>> f9eea98772763ae505793aee9f146a4ce5d07605
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

<<<<<<< HEAD
/// What was open stays, with all that was under way when another was to be opened.
void Studio::goOn(size_t failed)
{
    if (!opening_ || opening_->number != failed) return;
    const Opening opening = *std::exchange(opening_, std::nullopt);
    if (scan_ && (stage_ != Stage::solved || edit.parameters != solvedBy_))
        solveAgain();
    else if (opening.reevaluated && canReevaluate())
        reevaluate();
}

std::filesystem::path Studio::besideScan() const
{
    std::error_code ignored;
    return std::filesystem::is_directory(path_, ignored) ? path_ : path_.parent_path();
}

relamp::DelightOptions Studio::optionsOf(const SolverParameters& parameters) const
{
    relamp::DelightOptions options = parameters.options();
    if (options.solver != relamp::Solver::pathtrace) options.engine = engine_; // that has none
    return options;
}

void Studio::open(const std::filesystem::path& path, const relamp::ScanOptions& options)
{
    const size_t number = ++openings_;
    opening_ = Opening{number, edit.parameters, reevaluating_.has_value()};
    opening_->parameters.gather.lights.clear(); // places in another room
    opening_->parameters.gather.notLights.clear();
    hasFailed_ = false;
    reevaluating_.reset();
    isCameraUntouched = true;
    const Wish wish{path, options, optionsOf(opening_->parameters), number};
    solver_.start([this, wish](relamp::Progress& progress) {
        try {
            std::error_code ignored;
            std::filesystem::is_directory(wish.path, ignored) ? readFolder(wish, progress)
                                                              : readScan(wish, progress);
        } catch (const std::exception&) { // of which the worker tells
            mailbox_.post([this, number = wish.number] { goOn(number); });
            throw;
        }
    });
}

void Studio::readScan(const Wish& wish, relamp::Progress& progress)
{
    const auto scan =
        std::make_shared<const relamp::Scan>(relamp::readScan(wish.path, wish.scan, progress));
    const auto roomSolver = std::make_shared<RoomSolver>(scan, limits_);
    const auto opened = std::make_shared<const Opened>(
        Opened{wish, scan, std::make_shared<const RoomMesh>(roomMesh(*scan)),
               PageShrinker(*scan, limits_).textures(), roomSolver});
    mailbox_.post([this, opened] { adopt(*opened); });
    auto unlit = std::make_shared<relamp::DelitRoom>();
    unlit->scan = std::make_shared<const relamp::Scan>(relamp::coarsened(*scan, kGlanceLength));
    for (const relamp::Page& page : unlit->scan->pages) unlit->albedo.push_back(page.image);
    find(unlit, progress);
    roomSolver->solve(
        wish.parameters, {},
        [this, roomSolver](Solved solved) {
            mailbox_.post(
                [this, roomSolver, solved = std::make_shared<const Solved>(std::move(solved))] {
                    if (roomSolver == roomSolver_) adopt(*solved);
                });
        },
        progress);
}

void Studio::readFolder(const Wish& wish, relamp::Progress& progress)
{
    const auto solved =
        std::make_shared<const Solved>(readSolved(wish.path, wish.scan, limits_, progress));
    const auto opened = std::make_shared<const Opened>(Opened{
        wish, solved->room->scan, std::make_shared<const RoomMesh>(roomMesh(*solved->room->scan)),
        solved->photos, nullptr});
    mailbox_.post([this, solved, opened] {
        if (adopt(*opened)) adopt(*solved);
    });
    find(solved->room, progress);
}

/// Looks for a good view, where the scan has none, and for the walls that the camera keeps between.
void Studio::find(const std::shared_ptr<const relamp::DelitRoom>& room, relamp::Progress& progress)
{
    const auto photographer = std::make_shared<const relamp::Photographer>(*room, progress);
    std::optional<relamp::Camera> view;
    if (room->scan->cameras.empty()) view = photographer->goodView();
    mailbox_.post([this, room, photographer, view] {
        const auto reach = std::make_shared<Reach>(
            [room, photographer](glm::vec3 from, std::span<const glm::vec3> directions) {
                return photographer->distancesSeen(from, directions);
            },
            bounds_);
        if (view && isCameraUntouched)
            camera.set(*view, std::min(kAway * glm::length(bounds_.extent()),
                                       0.5f * reach->ahead(view->position, view->forward)));
        camera.setRoom(reach);
    });
}

/// False where another is wanted by now, or none.
bool Studio::adopt(const Opened& opened)
{
    if (!opening_ || opening_->number != opened.wish.number) return false;
    const SolverParameters solvedBy = std::exchange(opening_, std::nullopt)->parameters;
    relighting_.setRoom(nullptr, nullptr);
    path_ = opened.wish.path;
    lightsFolder_ = besideScan();
    reader_ = {};
    scan_ = opened.scan;
    roomSolver_ = opened.solver;
    mesh_ = opened.mesh;
    bounds_ = mesh_->bounds;
    decomposition_ = nullptr;
    captured_ = found_ = {};
    reevaluateMilliseconds_.reset();
    closure_.reset();
    timeline_.reset();
    isPlaying_ = isGlanced_ = isRelit_ = false;
    isLightOfScan_ = true;
    edit.light = {};
    edit.scanned = {};
    edit.parameters.gather.lights.clear();
    edit.parameters.gather.notLights.clear();
    selection = {}; // may be of the room before
    applied_ = edit;
    history_ = History<Edit>(edit);
    drawing_.setMesh(*mesh_, scan_->pages.size());
    drawing_.setLamps({});
    for (size_t p = 0; p < opened.textures.size(); ++p)
        drawing_.setTexture(p, PageTexture::scan, opened.textures[p]);
    if (isCameraUntouched)
        camera.set(firstView(*scan_, bounds_), kAway * glm::length(bounds_.extent()));
    camera.setRoom(nullptr);
    stage_ = Stage::scanned;
    solvedBy_ = solvedBy;
    for (const std::string& warning : scan_->warnings) say(warning);
    if (opened.solver && edit.parameters != solvedBy) solveAgain(); // they were changed meanwhile
    return true;
}

void Studio::adoptTextures(const Solved& solved)
{
    for (const auto& [which, pages] : solved.textures)
        for (size_t p = 0; p < std::min(pages.size(), drawing_.pages()); ++p)
            drawing_.setTexture(p, which, pages[p]);
    closure_ = solved.closure;
    isGlanced_ = isRelit_ = false;
}

void Studio::adopt(const Solved& solved)
{
    adoptTextures(solved);
    adoptFixtures(solved);
    stage_ = solved.isDraft ? Stage::drafted : Stage::solved;
    relighting_.setRoom(solved.room, mesh_);
    sendLight();
    if (solved.isDraft) return;
    decomposition_ = solved.decomposition;
    notes_.clear();
    tell(solved.notes);
    if (canReevaluate() && edit.scanned != solved.scanned) reevaluate(); // it was said meanwhile
}

/// The same room with another albedo.
void Studio::adoptReevaluated(const Solved& solved)
{
    adoptTextures(solved);
    if (solved.isDraft) return;
    const std::chrono::duration<double, std::milli> took =
        std::chrono::steady_clock::now() - *reevaluating_;
    reevaluateMilliseconds_ = took.count();
    reevaluating_.reset();
    captured_ = solved.captured;
    relighting_.repaint(solved.paint);
    sendLight();
    decomposition_ = solved.decomposition;
    tell(solved.notes);
    if (edit.scanned != solved.scanned || edit.parameters.albedo != solved.albedo) reevaluate();
}

/// Fixtures that were there before keep what was said of them, and stay selected.
void Studio::adoptFixtures(const Solved& solved)
{
    const std::vector<int> numbers = numbersOf(found_);
    if (isLightOfScan_)
        edit.light = documentOf(solved.captured);
    else
        edit.light.fixtures = carriedOver(edit.light.fixtures, numbers, solved.found, {.on = true});
    edit.scanned.fixtures = carriedOver(edit.scanned.fixtures, numbers, solved.found, kAsFound);
    captured_ = solved.captured;
    found_ = solved.found;
    if (selection.kind == Selection::Kind::fixture) {
        const size_t before = selection.index;
        if (before < numbers.size()) selection.index = found_.placeOf(numbers[before]);
        if (selection.index >= found_.fixtures.size()) selection = {};
    }
    applied_ = edit;
    if (!history_.canUndo() && !history_.canRedo()) history_ = History<Edit>(edit);
}

void Studio::sendLight()
{
    std::vector<std::string> notes;
    relamp::Relighting lighting;
    try {
        lighting = lightingOf(edit.light, lightsFolder_, captured_, notes, reader_);
    } catch (const relamp::Error& error) {
        return say(error.what()); // as by a picture of the sky that is gone
    }
    drawing_.setLamps(lampShapes(lighting.lights));
    drawing_.setSky(lighting.sky);
    isGlanced_ = isRelit_ = false;
    relighting_.setLight(std::move(lighting));
}

=======
>>>>>>> f9eea98772763ae505793aee9f146a4ce5d07605
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

<<<<<<< HEAD
void Studio::apply(const Edit& before)
{
    const bool isLightNew = !(edit.light == before.light);
    edit.light.fixtures.resize(captured_.fixtures.size());
    edit.scanned.fixtures.resize(captured_.fixtures.size(), kAsFound);
    applied_ = edit;
    if (isLightNew) {
        isLightOfScan_ = edit.light == documentOf(skyUnder(edit.scanned, found_));
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
    if (stage_ == Stage::solved && edit.parameters.solver == relamp::Solver::gather)
        return solveAgain(); // a folder, of which no more is kept than its pictures
    if (stage_ == Stage::solved)
        say("Only the solver Gather follows what is said of lamps on the day of the scan.");
}

=======
>>>>>>> f9eea98772763ae505793aee9f146a4ce5d07605
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
<<<<<<< HEAD
    if (!scan_ || opening_) return;
    hasFailed_ = false;
    reevaluating_.reset();
    stage_ = Stage::scanned;
    solvedBy_ = edit.parameters;
    if (!roomSolver_) roomSolver_ = std::make_shared<RoomSolver>(scan_, limits_);
    solver_.start([this, solver = roomSolver_, parameters = optionsOf(edit.parameters),
                   scanned = scannedLight()](relamp::Progress& progress) {
        solver->solve(
            parameters, scanned,
            [this, solver](Solved solved) {
                mailbox_.post(
                    [this, solver, solved = std::make_shared<const Solved>(std::move(solved))] {
                        if (solver == roomSolver_) adopt(*solved);
                    });
            },
            progress);
    });
=======
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
>>>>>>> f9eea98772763ae505793aee9f146a4ce5d07605
}

/// Computes again what the dials and the light of the day of the scan decide, and no more.
void Studio::follow(const Edit& before)
{
    Dials dials = before.dials;
    const bool isScannedNew = edit.scanned != before.scanned;
    const bool isDivisionNew = edit.dials.albedo != std::exchange(dials.albedo, edit.dials.albedo);
    if (edit.dials != dials || (isDivisionNew && !canResolve())) return solveAgain();
    if (!isScannedNew && !isDivisionNew) return;
    if (canResolve()) return resolve();
    if (room_.stage == Stage::solved && edit.dials.solver == relamp::Solver::gather)
        return solveAgain(); // a folder, of which no more is kept than its pictures
    if (room_.stage == Stage::solved)
        say("Only the solver Gather follows what is said of lamps on the day of the scan.");
}

<<<<<<< HEAD
/// Whether more of the room is kept than its pictures.
bool Studio::canReevaluate() const
{
    return !opening_ && stage_ == Stage::solved && roomSolver_ && decomposition_ &&
           decomposition_->optionsInForce().solver == relamp::Solver::gather;
}

/// What runs and is soon over is shown first, or nothing would be while a slider is drawn; the
/// newest wish follows when it is adopted.
void Studio::reevaluate()
{
    const auto now = std::chrono::steady_clock::now();
    if (reevaluating_ && now - *reevaluating_ < kPatience) return;
    hasFailed_ = false;
    reevaluating_ = now;
    solver_.start([this, solver = roomSolver_, albedo = edit.parameters.albedo,
                   scanned = scannedLight()](relamp::Progress& progress) {
        solver->reevaluate(
            albedo, scanned,
            [this, solver](Solved solved) {
                mailbox_.post(
                    [this, solver, solved = std::make_shared<const Solved>(std::move(solved))] {
                        if (solver == roomSolver_ && reevaluating_) adoptReevaluated(*solved);
                    });
            },
            progress);
    });
}

void Studio::stopSolving()
{
    reevaluating_.reset();
    opening_.reset();
    solver_.cancel();
}

bool Studio::isGlanced() const
{
    return isGlanced_ && !relighting_.status().glances;
}

bool Studio::isRelit() const
{
    return isRelit_ && isGlanced();
=======
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
>>>>>>> f9eea98772763ae505793aee9f146a4ce5d07605
}

bool Studio::rests() const
{
    return !opening_ && !solver_.status().isBusy && !saver_.status().isBusy &&
           light_.status().stage.empty() && (!drawing_.has(Layer::albedo) || light_.isRelit());
}
