#include "studio.h"

#include <algorithm>
#include <utility>

namespace
{

constexpr auto kPatience = std::chrono::seconds(1);

} // namespace

void Studio::open(const std::filesystem::path& path, const relamp::ScanOptions& options)
{
    opening_ = Opening{++openings_, edit.parameters, reevaluating_.has_value()};
    opening_->parameters.forgetPlaces();
    hasFailed_ = false;
    reevaluating_.reset();
    isCameraUntouched = true;
    solver_.start([this, path, options, number = opening_->number, limits = drawing_.limits(),
                   parameters = optionsOf(opening_->parameters)](relamp::Progress& progress) {
        try {
            const auto read =
                std::make_shared<const ReadRoom>(readRoom(path, options, limits, progress));
            mailbox_.post([this, read, number] {
                if (opening_ && opening_->number == number) adopt(*read);
            });
            const Surroundings around = surroundingsOf(*read, progress);
            mailbox_.post([this, read, around] {
                if (room_.scan == read->scan) look(around);
            });
            if (read->solver)
                read->solver->solve(parameters, {}, sendTo(&Studio::adoptSolved, read->solver),
                                    progress);
        } catch (const std::exception&) { // of which the worker tells
            mailbox_.post([this, number] { goOn(number); });
            throw;
        }
    });
}

void Studio::adopt(const ReadRoom& read)
{
    room_ = {.path = read.path,
             .scan = read.scan,
             .mesh = read.mesh,
             .solver = read.solver,
             .solvedBy = std::exchange(opening_, std::nullopt)->parameters,
             .stage = Stage::scanned,
             .lightsFolder = folderOf(read.path)};
    edit.light = {};
    edit.scanned = {};
    edit.parameters.forgetPlaces();
    selection = {}; // may be of the room before, as what was clicked on
    place.reset();
    paint.reset();
    applied_ = edit;
    history_ = History<Edit>(edit);
    light_.setRoom(nullptr, nullptr);
    drawing_.setMesh(*room_.mesh, room_.scan->pages.size());
    drawing_.setLamps({});
    for (size_t p = 0; p < read.textures.size(); ++p)
        drawing_.setTexture(p, PageTexture::scan, read.textures[p]);
    if (isCameraUntouched) {
        const Outlook outlook = firstOutlook(read);
        camera.set(outlook.camera, outlook.distance);
    }
    camera.setRoom(nullptr);
    for (const std::string& warning : room_.scan->warnings) say(warning);
    if (read.solved) adoptSolved(*read.solved);
    if (read.solver && edit.parameters != room_.solvedBy)
        solveAgain(); // they were turned meanwhile
}

void Studio::look(const Surroundings& around)
{
    if (around.outlook && isCameraUntouched)
        camera.set(around.outlook->camera, around.outlook->distance);
    camera.setRoom(around.reach);
}

/// What was open stays, with all that was under way when another was to be opened.
void Studio::goOn(size_t failed)
{
    if (!opening_ || opening_->number != failed) return;
    const Opening opening = *std::exchange(opening_, std::nullopt);
    if (room_.scan && (room_.stage != Stage::solved || edit.parameters != room_.solvedBy))
        solveAgain();
    else if (opening.reevaluated && canReevaluate())
        reevaluate();
}

relamp::DelightOptions Studio::optionsOf(const SolverParameters& parameters) const
{
    relamp::DelightOptions options = parameters.options();
    if (options.solver != relamp::Solver::pathtrace) options.engine = engine_; // that has none
    return options;
}

ScannedLight Studio::scannedLight() const
{
    return {.items = edit.scanned, .numbers = numbersOf(room_.found), .light = edit.light};
}

/// Brings what a solver finds to the main thread, which forgets it where another room is open by
/// then.
std::function<void(Solved)> Studio::sendTo(Adopt adopt, const std::shared_ptr<RoomSolver>& from)
{
    return [this, adopt, from](Solved found) {
        const auto solved = std::make_shared<const Solved>(std::move(found));
        mailbox_.post([this, adopt, from, solved] {
            if (from == room_.solver) (this->*adopt)(*solved);
        });
    };
}

void Studio::solveAgain()
{
    if (!room_.scan || opening_) return;
    hasFailed_ = false;
    reevaluating_.reset();
    room_.stage = Stage::scanned;
    room_.solvedBy = edit.parameters;
    if (!room_.solver) room_.solver = std::make_shared<RoomSolver>(room_.scan, drawing_.limits());
    solver_.start([solver = room_.solver, parameters = optionsOf(edit.parameters),
                   scanned = scannedLight(),
                   found = sendTo(&Studio::adoptSolved, room_.solver)](relamp::Progress& progress) {
        solver->solve(parameters, scanned, found, progress);
    });
}

/// Whether more of the room is kept than its pictures.
bool Studio::canReevaluate() const
{
    return !opening_ && room_.stage == Stage::solved && room_.solver && room_.decomposition &&
           room_.decomposition->optionsInForce().solver == relamp::Solver::gather;
}

/// What runs and is soon over is shown first, or nothing would be while a slider is drawn; the
/// newest wish follows when it is adopted.
void Studio::reevaluate()
{
    const auto now = std::chrono::steady_clock::now();
    if (reevaluating_ && now - *reevaluating_ < kPatience) return;
    hasFailed_ = false;
    reevaluating_ = now;
    solver_.start(
        [solver = room_.solver, albedo = edit.parameters.albedo, scanned = scannedLight(),
         found = sendTo(&Studio::adoptReevaluated, room_.solver)](relamp::Progress& progress) {
            solver->reevaluate(albedo, scanned, found, progress);
        });
}

void Studio::stopSolving()
{
    reevaluating_.reset();
    opening_.reset();
    solver_.cancel();
}

void Studio::adoptSolved(const Solved& solved)
{
    adoptTextures(solved);
    adoptFixtures(solved);
    room_.stage = solved.isDraft ? Stage::drafted : Stage::solved;
    light_.setRoom(solved.room, room_.mesh);
    sendLight();
    if (solved.isDraft) return;
    room_.decomposition = solved.decomposition;
    room_.notes.clear();
    tell(solved.notes);
    if (canReevaluate() && edit.scanned != solved.scanned) reevaluate(); // it was said meanwhile
}

/// The same room with another albedo.
void Studio::adoptReevaluated(const Solved& solved)
{
    if (!reevaluating_) return; // it was broken off
    adoptTextures(solved);
    if (solved.isDraft) return;
    const std::chrono::duration<double, std::milli> took =
        std::chrono::steady_clock::now() - *reevaluating_;
    room_.reevaluateMilliseconds = took.count();
    reevaluating_.reset();
    room_.captured = solved.captured;
    light_.repaint(solved.paint);
    sendLight();
    room_.decomposition = solved.decomposition;
    tell(solved.notes);
    if (edit.scanned != solved.scanned || edit.parameters.albedo != solved.albedo) reevaluate();
}

void Studio::adoptTextures(const Solved& solved)
{
    for (const auto& [which, pages] : solved.textures)
        for (size_t p = 0; p < std::min(pages.size(), drawing_.pages()); ++p)
            drawing_.setTexture(p, which, pages[p]);
    room_.closure = solved.closure;
    light_.outdate();
}

/// Fixtures that were there before keep what was said of them, and stay selected.
void Studio::adoptFixtures(const Solved& solved)
{
    const std::vector<int> numbers = numbersOf(room_.found);
    if (room_.isLightOfScan)
        edit.light = documentOf(solved.captured);
    else
        edit.light.fixtures = carriedOver(edit.light.fixtures, numbers, solved.found, {.on = true});
    edit.scanned.fixtures = carriedOver(edit.scanned.fixtures, numbers, solved.found, kAsFound);
    room_.captured = solved.captured;
    room_.found = solved.found;
    if (selection.kind == Selection::Kind::fixture) {
        const size_t before = selection.index;
        if (before < numbers.size()) selection.index = room_.found.placeOf(numbers[before]);
        if (selection.index >= room_.found.fixtures.size()) selection = {};
    }
    applied_ = edit;
    if (!history_.canUndo() && !history_.canRedo()) history_ = History<Edit>(edit);
}
