#include "studio.h"

#include "lamp_shapes.h"

#include "relamp/error.h"
#include "relamp/picture.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <glm/geometric.hpp>

namespace
{

constexpr int kGlanceLength = 1024; // pixels of pages by which a first view is looked for
constexpr size_t kMessages = 6;

/// Somewhere inside, until a good view is found.
relamp::Camera firstView(const relamp::Scan& scan, const relamp::Bounds& box)
{
    if (!scan.cameras.empty()) return scan.cameras.front().camera;
    const glm::vec3 extent = box.extent();
    const glm::vec3 eye = box.low + extent * glm::vec3(0.2f, 0.6f, 0.8f);
    const glm::vec3 way = box.low + extent * glm::vec3(0.75f, 0.4f, 0.2f) - eye;
    const float length = glm::length(way);
    return {eye, length > 0.0f ? way / length : glm::vec3(0, 0, -1), {0, 1, 0}, 1.3f};
}

auto tied(const relamp::GatherOptions& o)
{
    return std::tie(o.quality, o.rays, o.shadowRays, o.lights, o.notLights);
}

auto tied(const relamp::ThesisOptions& o)
{
    return std::tie(o.emitterThreshold, o.expansion, o.lightLevels, o.attenuation, o.power,
                    o.ambient, o.mergeDistance, o.rsmSize, o.lpvSize, o.lpvSteps, o.flattenReach,
                    o.flattenRange, o.useLpv, o.useAmbient);
}

} // namespace

bool Dials::operator==(const Dials& other) const
{
    return solver == other.solver && samples == other.samples &&
           tied(gather) == tied(other.gather) && tied(thesis) == tied(other.thesis) &&
           albedo.darkest == other.albedo.darkest && albedo.fill == other.albedo.fill;
}

relamp::DelightOptions Dials::options() const
{
    relamp::DelightOptions options;
    options.solver = solver;
    options.gather = gather;
    options.thesis = thesis;
    options.albedo = albedo;
    options.pathtrace.samples = samples;
    return options;
}

bool Edit::operator==(const Edit& other) const
{
    return light == other.light && dials == other.dials && view.view == other.view.view &&
           view.exposure == other.view.exposure;
}

Studio::Studio(RoomDrawing& drawing, const relamp::EngineOptions& engine,
               std::function<void()> wake)
    : drawing_(drawing), engine_(engine), mailbox_(wake), history_(edit),
      relighting_(engine,
                  {.glance =
                       [this](std::vector<relamp::LightAtPlace> light, double milliseconds) {
                           mailbox_.post([this, light = std::move(light), milliseconds] {
                               drawing_.removeTextures(PageTexture::relit);
                               drawing_.setLight(light);
                               glanceMilliseconds_ = milliseconds;
                               isGlanced_ = !relighting_.status().glances;
                           });
                       },
                   .textures =
                       [this](std::vector<TexturePixels> pages) {
                           mailbox_.post([this, pages = std::move(pages)] {
                               const auto status = relighting_.status();
                               if (status.glances || status.refines) return; // out of date
                               for (size_t p = 0; p < std::min(pages.size(), drawing_.pages()); ++p)
                                   drawing_.setTexture(p, PageTexture::relit, pages[p]);
                               isRelit_ = true;
                           });
                       },
                   .failed =
                       [this](const std::string& sentence) {
                           mailbox_.post([this, sentence] { fail(sentence); });
                       },
                   .changed = wake}),
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

void Studio::fail(const std::string& sentence)
{
    hasFailed_ = true;
    if (stage_ == Stage::reading) stage_ = scan_ ? Stage::scanned : Stage::nothing;
    say(sentence);
}

std::filesystem::path Studio::besideScan() const
{
    std::error_code ignored;
    return std::filesystem::is_directory(path_, ignored) ? path_ : path_.parent_path();
}

relamp::DelightOptions Studio::dials() const
{
    relamp::DelightOptions options = edit.dials.options();
    if (options.solver == relamp::Solver::thesis) options.engine = engine_; // of no other
    return options;
}

void Studio::open(const std::filesystem::path& path, const relamp::ScanOptions& options)
{
    stage_ = Stage::reading;
    hasFailed_ = false;
    path_ = path;
    lightsFolder_ = besideScan();
    isCameraUntouched = true;
    isLightOfScan_ = true;
    selection = {};
    timeline_.reset();
    isPlaying_ = false;
    edit.dials.gather.lights.clear(); // places in another room
    edit.dials.gather.notLights.clear();
    applied_ = edit;
    solver_.start([this, path, options, dials = dials()](relamp::Progress& progress) {
        std::error_code ignored;
        std::filesystem::is_directory(path, ignored) ? readFolder(path, progress)
                                                     : readScan(path, options, progress, dials);
    });
}

void Studio::readScan(const std::filesystem::path& path, const relamp::ScanOptions& options,
                      relamp::Progress& progress, const relamp::DelightOptions& dials)
{
    const auto scan =
        std::make_shared<const relamp::Scan>(relamp::readScan(path, options, progress));
    std::vector<relamp::Image> pages;
    auto mesh = std::make_shared<const RoomMesh>(roomMesh(*scan));
    std::vector<TexturePixels> textures;
    for (const relamp::Page& page : scan->pages)
        textures.push_back(
            texturePixels(page.image, TexelFormat::srgb8, kLargestTexture, !page.ofVertices));
    mailbox_.post(
        [this, scan, mesh, textures = std::move(textures)] { adopt(scan, mesh, textures); });
    auto unlit = std::make_shared<relamp::DelitRoom>();
    unlit->scan = relamp::coarsened(*scan, kGlanceLength);
    for (const relamp::Page& page : unlit->scan.pages) unlit->albedo.push_back(page.image);
    if (scan->cameras.empty()) find(unlit, progress);
    solve(
        scan, dials,
        [this](Solved solved) {
            mailbox_.post([this, solved = std::make_shared<const Solved>(std::move(solved))] {
                adopt(*solved);
            });
        },
        progress);
}

void Studio::readFolder(const std::filesystem::path& path, relamp::Progress& progress)
{
    auto solved = std::make_shared<const Solved>(readSolved(path, progress));
    auto mesh = std::make_shared<const RoomMesh>(roomMesh(*solved->scan));
    std::vector<TexturePixels> textures;
    for (const relamp::Page& page : solved->scan->pages)
        textures.push_back(
            texturePixels(page.image, TexelFormat::srgb8, kLargestTexture, !page.ofVertices));
    mailbox_.post([this, solved, mesh, textures = std::move(textures)] {
        adopt(solved->scan, mesh, textures);
        adopt(*solved);
    });
    if (solved->scan->cameras.empty()) find(solved->room, progress);
}

/// Looks for a good view.
void Studio::find(const std::shared_ptr<const relamp::DelitRoom>& room, relamp::Progress& progress)
{
    const relamp::Camera view = relamp::Photographer(*room, progress).goodView();
    mailbox_.post([this, view] {
        if (isCameraUntouched) camera.set(view, 0.4f * glm::length(bounds_.extent()));
    });
}

void Studio::adopt(std::shared_ptr<const relamp::Scan> scan, std::shared_ptr<const RoomMesh> mesh,
                   const std::vector<TexturePixels>& pages)
{
    relighting_.setRoom(nullptr, nullptr);
    scan_ = std::move(scan);
    mesh_ = std::move(mesh);
    bounds_ = mesh_->bounds;
    decomposition_ = nullptr;
    captured_ = {};
    closure_.reset();
    isGlanced_ = isRelit_ = false;
    edit.light = {};
    applied_ = edit;
    history_ = History<Edit>(edit);
    drawing_.setMesh(*mesh_, scan_->pages.size());
    drawing_.setLamps({});
    for (size_t p = 0; p < pages.size(); ++p) drawing_.setTexture(p, PageTexture::scan, pages[p]);
    if (isCameraUntouched)
        camera.set(firstView(*scan_, bounds_), 0.4f * glm::length(bounds_.extent()));
    stage_ = Stage::scanned;
    for (const std::string& warning : scan_->warnings) say(warning);
}

void Studio::adopt(const Solved& solved)
{
    for (const auto& [which, pages] : solved.textures)
        for (size_t p = 0; p < std::min(pages.size(), drawing_.pages()); ++p)
            drawing_.setTexture(p, which, pages[p]);
    adoptFixtures(solved.room->captured);
    closure_ = solved.closure;
    stage_ = solved.isDraft ? Stage::drafted : Stage::solved;
    isGlanced_ = isRelit_ = false;
    relighting_.setRoom(solved.room, mesh_);
    sendLight();
    if (solved.isDraft) return;
    decomposition_ = solved.decomposition;
    decomposed_ = solved.scan;
    for (const std::string& note : solved.notes) say(note);
}

/// Fixtures that are where one was keep what was said of it.
void Studio::adoptFixtures(const relamp::Lights& captured)
{
    constexpr float kSamePlace = 0.15f; // m
    LightDocument next = documentOf(captured);
    if (!isLightOfScan_) {
        for (size_t i = 0; i < captured.fixtures.size(); ++i)
            for (size_t j = 0; j < std::min(captured_.fixtures.size(), edit.light.fixtures.size());
                 ++j)
                if (glm::distance(captured.fixtures[i].centre, captured_.fixtures[j].centre) <
                    kSamePlace)
                    next.fixtures[i] = edit.light.fixtures[j];
        edit.light.fixtures = next.fixtures;
    } else {
        edit.light = next;
    }
    captured_ = captured;
    if (selection.kind == Selection::Kind::fixture && selection.index >= captured_.fixtures.size())
        selection = {};
    applied_ = edit;
    if (!history_.canUndo() && !history_.canRedo()) history_ = History<Edit>(edit);
}

void Studio::sendLight()
{
    std::vector<std::string> notes;
    relamp::Relighting lighting;
    try {
        lighting = lightingOf(edit.light, lightsFolder_, captured_, notes);
    } catch (const relamp::Error& error) {
        return say(error.what()); // as by a picture of the sky that is gone
    }
    drawing_.setLamps(lampShapes(lighting.lights));
    drawing_.setSky(lighting.sky);
    isGlanced_ = isRelit_ = false;
    relighting_.setLight(std::move(lighting));
}

void Studio::commit(const std::string& step)
{
    if (edit == applied_) return;
    history_.record(edit, step);
    apply(applied_);
}

void Studio::apply(const Edit& before)
{
    const bool isLightNew = !(edit.light == before.light);
    const bool areDialsNew = !(edit.dials == before.dials);
    edit.light.fixtures.resize(captured_.fixtures.size());
    applied_ = edit;
    if (isLightNew) {
        isLightOfScan_ = false;
        play(false);
        if (selection.kind == Selection::Kind::lamp && selection.index >= edit.light.lamps.size())
            selection = {};
        sendLight();
    }
    if (areDialsNew) solveAgain();
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

void Studio::solveAgain()
{
    if (!scan_ || stage_ == Stage::reading) return;
    hasFailed_ = false;
    stage_ = Stage::scanned;
    solver_.start([this, scan = scan_, dials = dials()](relamp::Progress& progress) {
        solve(
            scan, dials,
            [this, scan](Solved solved) {
                mailbox_.post(
                    [this, scan, solved = std::make_shared<const Solved>(std::move(solved))] {
                        if (scan == scan_) adopt(*solved);
                    });
            },
            progress);
    });
}

bool Studio::isGlanced() const
{
    return isGlanced_ && !relighting_.status().glances;
}

bool Studio::isRelit() const
{
    return isRelit_ && isGlanced();
}

bool Studio::rests() const
{
    const RelightingThread::Status relighting = relighting_.status();
    return stage_ != Stage::reading && !solver_.status().isBusy && !saver_.status().isBusy &&
           relighting.stage.empty() && (!drawing_.has(Layer::albedo) || isRelit());
}
