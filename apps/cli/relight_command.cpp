#include "command.h"
#include "interrupt.h"
#include "light_arguments.h"
#include "picture_arguments.h"
#include "pipes.h"
#include "scan_arguments.h"
#include "terminal.h"

#include "relamp/error.h"
#include "relamp/film.h"
#include "relamp/lightmaps.h"
#include "relamp/names.h"
#include "relamp/relight.h"
#include "relamp/threads.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

namespace
{

struct RelightArguments
{
    ScanArguments room; // a folder of delight's, or a scan whose texture is an albedo
    relamp::DelitOptions delit;
    relamp::RelightOptions options;
    PictureArguments picture;
    LightArguments light;
    std::filesystem::path output;
    bool bake = false;
    std::optional<relamp::LightmapFormat> lightmaps; // of each light; none: one of all together
    int side = 0;                                    // pixels, of these
    bool force = false;
    bool keepNothing = false;
    bool quiet = false;
};

relamp::Relighting lightingOf(const RelightArguments& arguments, const relamp::Lights& captured,
                              std::vector<std::string>& warnings)
{
    const bool isOfScan = arguments.lightmaps.has_value() && !arguments.light.areGiven();
    return arguments.light.in(
        captured, isOfScan ? relamp::asCaptured(captured) : relamp::darkened(captured), warnings);
}

bool isDark(const relamp::Relighting& lighting)
{
    return lighting.lights.empty() && lighting.sky.radiance == glm::vec3(0.0f) &&
           std::all_of(lighting.fixtures.begin(), lighting.fixtures.end(),
                       [](const auto& lit) { return lit.fixture.radiance == glm::vec3(0.0f); });
}

std::string nothingShines(const RelightArguments& arguments, const relamp::DelitRoom& room)
{
    if (room.captured.fixtures.empty())
        return fmt::format("nothing shines, so all is black: {} tells of no lights of its own; "
                           "bring new ones with --lights",
                           arguments.room.file.string());
    return "nothing shines, so all is black; --fixture all=on turns the room's own lights on, "
           "--lights brings new ones";
}

/// What is asked for beside light, found before anything takes long.
struct Wish
{
    std::optional<relamp::Camera> camera; // none: the photographer chooses
    std::optional<relamp::Timeline> timeline;
};

Wish wishOf(const RelightArguments& arguments, const relamp::DelitRoom& room,
            std::vector<std::string>& notes)
{
    Wish wish;
    const PictureArguments& picture = arguments.picture;
    if (picture.camera != "auto")
        wish.camera = relamp::cameraFor(picture.camera, *room.scan, notes);
    if (!picture.timeline.empty()) wish.timeline.emplace(picture.timeline, room.captured, notes);
    return wish;
}

relamp::Film filmOf(const RelightArguments& arguments, const Wish& wish)
{
    const PictureArguments& picture = arguments.picture;
    relamp::Film film{.picture = picture.options, .framesPerSecond = picture.framesPerSecond};
    if (arguments.force) film.replacing = relamp::Replacing::any;
    film.turns = picture.turntable > 0;
    film.frames = picture.turntable;
    if (wish.timeline) film.timeline = &*wish.timeline;
    if (wish.timeline && !film.turns)
        film.frames = relamp::framesOf(*wish.timeline, film.framesPerSecond);
    return film;
}

bool isOfTexture(const RelightArguments& arguments)
{
    return arguments.bake || arguments.picture.show != Show::relit;
}

bool isMeasured(const RelightArguments& arguments)
{
    return arguments.picture.exposureOf(isOfTexture(arguments)).automatic &&
           arguments.output.extension() != ".exr"; // which is the light itself
}

/// How a picture is shown; `measure` is asked for the automatic exposure where it is wanted.
template<class Measure>
relamp::ViewOptions viewOf(const RelightArguments& arguments, const Measure& measure)
{
    const bool isTexture = isOfTexture(arguments);
    const float stops = arguments.picture.exposureOf(isTexture).stops;
    return {.view = arguments.picture.viewOf(isTexture),
            .exposure = isMeasured(arguments) ? stops + measure() : stops};
}

/// The room as it was scanned, or as it is without light. Gives its exposure.
float writeUnlit(const RelightArguments& arguments, const relamp::DelitRoom& room, const Wish& wish,
                 relamp::Progress& progress)
{
    const std::vector<relamp::Image> pages =
        arguments.picture.show == Show::scan ? relamp::readScanned(room, arguments.delit, progress)
                                             : room.albedo;
    const relamp::Photographer photographer(room, progress);
    const relamp::Camera camera = wish.camera ? *wish.camera : photographer.goodView();
    relamp::PictureOptions picture = arguments.picture.options;
    picture.view = viewOf(arguments, [&] {
        return photographer.automaticExposure(pages, camera, picture, progress);
    });
    photographer.write(pages, camera, picture, arguments.output, progress);
    return picture.view.exposure;
}

/// Whether no light comes from where a camera looks.
bool seesNothing(const relamp::Photographer& photographer, std::span<const relamp::Image> pages,
                 const relamp::Film& film, relamp::Progress& progress)
{
    relamp::PictureOptions small = film.picture;
    small.width = 64;
    small.height = 36;
    const relamp::Image seen = photographer.take(pages, film.camera, small, progress);
    return std::ranges::all_of(seen.half(), [](uint16_t value) { return value == 0; });
}

/// Gives the exposure; `notes` receives what is doubtful of the picture.
float writeRelit(const RelightArguments& arguments, relamp::Relighter& relighter,
                 const relamp::Relighting& lighting, const Wish& wish,
                 std::vector<std::string>& notes, relamp::Progress& progress)
{
    const relamp::Photographer photographer(relighter);
    relamp::Film film = filmOf(arguments, wish);
    film.camera = wish.camera  ? *wish.camera
                  : film.turns ? photographer.goodPlaceToTurn()
                               : photographer.goodView();
    film.picture.sky = lighting.sky;
    film.picture.lamps = lighting.lights;
    if (arguments.picture.isFilm()) {
        film.picture.view = viewOf(arguments, [&] {
            return relamp::automaticExposure(relighter, photographer, film, progress);
        });
        relamp::writeFilm(relighter, photographer, film, arguments.output, progress);
        return film.picture.view.exposure;
    }
    const std::vector<relamp::Image> pages = relamp::radianceOfPages(relighter, progress);
    film.picture.view = viewOf(arguments, [&] {
        return photographer.automaticExposure(pages, film.camera, film.picture, progress);
    });
    photographer.write(pages, film.camera, film.picture, arguments.output, progress);
    if (!isDark(lighting) && seesNothing(photographer, pages, film, progress))
        notes.emplace_back("no light reaches what the camera sees, so the picture is black; name "
                           "another place with --camera");
    return film.picture.view.exposure;
}

float writeBaked(const RelightArguments& arguments, const relamp::Relighter& relighter,
                 relamp::Progress& progress)
{
    const relamp::ViewOptions view = viewOf(arguments, [] { return 0.0f; });
    relamp::writeBaked(relighter, arguments.output, view, progress);
    return view.exposure;
}

relamp::LightmapOptions lightmapsOf(const RelightArguments& arguments)
{
    return {.format = arguments.lightmaps.value_or(relamp::LightmapFormat::exr),
            .longestSide = arguments.side,
            .replacing = arguments.force ? relamp::Replacing::any : relamp::Replacing::unchanged};
}

/// Gives the exposure; `notes` receives what is doubtful of the light or of the room.
float write(RelightArguments& arguments, const relamp::DelitRoom& room,
            std::vector<std::string>& notes, relamp::Progress& progress)
{
    const Wish wish = wishOf(arguments, room, notes);
    if (arguments.picture.show != Show::relit) return writeUnlit(arguments, room, wish, progress);
    if (arguments.picture.isFilm()) relamp::checkFilm(filmOf(arguments, wish), arguments.output);
    if (arguments.lightmaps) relamp::checkLightmaps(arguments.output, lightmapsOf(arguments));
    const relamp::Relighting lighting = lightingOf(arguments, room.captured, notes);
    if (isDark(lighting) && !wish.timeline) notes.push_back(nothingShines(arguments, room));
    if (!arguments.keepNothing) arguments.options.transport = room.transport;
    relamp::Relighter relighter(room, arguments.options, progress);
    if (arguments.lightmaps) {
        relamp::writeLightmaps(relighter, lighting, arguments.output, lightmapsOf(arguments),
                               progress);
        return 0.0f;
    }
    relighter.light(lighting, progress);
    const float exposure = arguments.bake
                               ? writeBaked(arguments, relighter, progress)
                               : writeRelit(arguments, relighter, lighting, wish, notes, progress);
    notes.insert(notes.end(), relighter.warnings().begin(), relighter.warnings().end());
    return exposure;
}

/// Before long work begins. Folders above a film's own are made where they are not there.
void checkPlace(const RelightArguments& arguments)
{
    const std::filesystem::path& output = arguments.output;
    const bool isFolder =
        arguments.lightmaps.has_value() || (arguments.picture.isFilm() && !relamp::isVideo(output));
    std::filesystem::path folder = output.has_parent_path() ? output.parent_path() : ".";
    std::error_code error;
    while (isFolder && !std::filesystem::exists(folder, error) && folder != folder.parent_path())
        folder = folder.has_parent_path() ? folder.parent_path() : ".";
    if (access(folder.c_str(), W_OK) == 0) return;
    throw relamp::Error(relamp::ErrorCode::cannotWrite,
                        fmt::format("{}: cannot be written: {}: {}; make that folder, or name "
                                    "another with -o",
                                    output.string(), folder.string(), std::strerror(errno)));
}

void checkIsNotScan(const std::filesystem::path& output, const relamp::DelitRoom& room)
{
    std::error_code ignored;
    if (std::filesystem::equivalent(output, room.scanFile, ignored))
        throw relamp::Error(relamp::ErrorCode::cannotWrite,
                            fmt::format("{}: is the scan itself and would be overwritten; name "
                                        "another file with -o",
                                        output.string()));
}

int run(RelightArguments& arguments)
{
    const auto start = std::chrono::steady_clock::now();
    // Before Ctrl-C is kept for the work, for nothing else ends a wait for a person's typing.
    arguments.light.readPipe();
    std::optional<PipedFile> piped;
    if (isPipe(arguments.output)) arguments.output = piped.emplace(".png").path();
    const Talk talk = arguments.quiet ? Talk::quiet : Talk::normal;
    relamp::Progress progress(progressDisplay(talk));
    const Interrupt interrupt(progress);
    const relamp::ThreadLimit threads(arguments.room.threads);
    relamp::checkDevice(arguments.options.engine);
    checkPlace(arguments);

    arguments.delit.asScan = arguments.room.options;
    const relamp::DelitRoom room =
        relamp::readDelitRoom(arguments.room.file, arguments.delit, progress);
    checkIsNotScan(arguments.output, room);
    std::vector<std::string> notes = room.warnings;
    const float exposure = write(arguments, room, notes, progress);

    endProgressDisplay(talk);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    if (piped) piped->send();
    if (talk == Talk::quiet) return 0;
    if (!piped)
        printAside(
            fmt::format("{}: {} in {:.1f} s{}\n", arguments.room.file.string(),
                        arguments.output.string(), elapsed.count(),
                        isMeasured(arguments) ? fmt::format(", exposure {:.2f}", exposure) : ""));
    for (const std::string& note : notes) printProblem("note: " + note);
    return 0;
}

/// What stands against writing `output`, or nothing; it is a matter of its name.
std::string complaintOfOutput(const RelightArguments& arguments)
{
    const std::string ending = arguments.output.extension().string();
    const bool isPicture = ending == ".png" || ending == ".exr" || isPipe(arguments.output);
    const PictureArguments& picture = arguments.picture;
    if (isPipe(arguments.output) && (arguments.bake || picture.isFilm()))
        return "a single picture goes to -, as PNG; name a file or a folder for what --bake, "
               "--turntable "
               "and --timeline write";
    if (arguments.bake && (picture.isFilm() || picture.show != Show::relit))
        return "--bake goes with one light, neither with films nor with --show";
    if (!arguments.bake && arguments.lightmaps) return "--per-lamp goes with --bake";
    if (!arguments.lightmaps && arguments.side > 0) return "--side goes with --bake --per-lamp";
    if (arguments.lightmaps && !ending.empty())
        return "with --bake --per-lamp, the name after -o is that of a folder, without an ending";
    if (arguments.bake && !arguments.lightmaps && ending != ".exr" && ending != ".glb")
        return "with --bake, the name after -o must end in .exr or .glb";
    if (arguments.bake && picture.exposureOf(true).automatic)
        return "--exposure auto goes with pictures and films; give --bake a number of stops";
    if (picture.isFilm() && picture.show != Show::relit) return "--show goes with single pictures";
    try {
        if (picture.isFilm()) relamp::isVideo(arguments.output);
    } catch (const relamp::Error& error) {
        return error.what();
    }
    if (!arguments.bake && !picture.isFilm() && !isPicture)
        return "the name after -o must end in .png or .exr; or add --bake, --turntable or "
               "--timeline";
    return "";
}

void addSolverOptions(CLI::App& command, relamp::RelightOptions& options)
{
    command
        .add_option("--solver", options.solver,
                    "gather (shadows and radiosity), pathtrace (slow, the reference), or thesis "
                    "(no shadows, one bounce) [gather]")
        ->transform(oneOf<relamp::Solver>())
        ->type_name("NAME");
    command
        .add_option(
            "--rays", options.rays,
            "Rays from every small piece of surface that look for bounce light [by their number]")
        ->check(between(4, 1024))
        ->type_name("N");
    command
        .add_option("--shadow-rays", options.shadowRays,
                    "Rays of a place in a half shadow (penumbra) to each light [16]")
        ->check(between(1, 1024))
        ->type_name("N");
    command.add_option("--samples", options.pathtrace.samples, "Paths from every texel [64]")
        ->check(between(1, 65536))
        ->type_name("N");
    command.add_option("--seed", options.pathtrace.seed, "Of the paths' random numbers [1]")
        ->check(between(0, 4294967295.0))
        ->type_name("N");
}

void addRoomOptions(CLI::App& command, RelightArguments& arguments)
{
    command
        .add_option("--albedo", arguments.delit.albedo,
                    "Pictures to take for the room's albedo, one for each of its textures")
        ->type_name("FILE");
    command.add_flag("--texture-is-albedo", arguments.delit.textureIsAlbedo,
                     "SCAN is a model into whose texture no light was ever baked");
    command
        .add_option("--scan", arguments.delit.scan,
                    "Where the scan is, for --show scan, if it was moved")
        ->type_name("FILE");
}

} // namespace

void addRelightCommand(CLI::App& app, Run& run)
{
    CLI::App& command = *app.add_subcommand(
        "relight", "Put new light into a room that delight took the light out of");
    const auto arguments = std::make_shared<RelightArguments>();
    addScanArguments(command, arguments->room);
    command.get_option("scan")->description("What relamp delight was given as -o, or a GLB whose "
                                            "texture is an albedo");
    command
        .add_option("-o,--output", arguments->output,
                    "A picture, .png or .exr, or - for a PNG on standard output; of films a "
                    "folder, or .mp4; with --bake "
                    "radiance.exr, one for each texture, or a model, baked.glb, or a folder")
        ->required()
        ->type_name("FILE");
    command.add_flag("--bake", arguments->bake, "Bake the light into textures");
    command
        .add_option("--per-lamp", arguments->lightmaps,
                    "With --bake: a lightmap of each light by itself, exr or png, and "
                    "lightmaps.json, into the folder -o; of the room's own lights, where no others "
                    "are given (docs/guide/lightmaps.md)")
        ->transform(oneOf<relamp::LightmapFormat>())
        ->type_name("FORMAT");
    command
        .add_option("--side", arguments->side,
                    "Pixels of a lightmap along a side, at most [as the texture]")
        ->check(between(1, 65536))
        ->type_name("N");
    addLightArguments(command, arguments->light, "The new light",
                      "A lamp or window that delight found, by its number or name in lights.json, "
                      "or all of them: N=on, N=off, N=50%, N=2700K,800lm, N=window; off otherwise");
    addRoomOptions(command, *arguments);
    addPictureArguments(command, arguments->picture);
    addSolverOptions(command, arguments->options);
    addEngineArguments(command, arguments->options.engine, "bounces");
    command.add_flag(
        "--no-transport", arguments->keepNothing,
        "Neither read nor write DIR/transport.bin, which keeps where bounce light goes, so "
        "that the next run is faster");
    command.add_flag("--force", arguments->force,
                     "Replace frames of a folder that relamp did not write, or that were changed");
    command.add_flag("-q,--quiet", arguments->quiet, "Say nothing but errors");
    command.footer(
        "Examples:\n"
        "  relamp relight kitchen --lights lamp.json -o frame.png\n"
        "  relamp relight kitchen --lights lamp.json -o light.png --view standard --exposure 0\n"
        "  relamp relight kitchen --timeline day.json -o day.mp4\n"
        "  relamp relight kitchen --lights lamp.json --bake -o radiance.exr\n"
        "  relamp relight kitchen --fixture all=on --fixture 2=off --bake -o baked.glb\n"
        "  relamp relight kitchen --bake --per-lamp exr -o lightmaps");
    command.callback([arguments, &run] {
        const std::string complaint = complaintOfOutput(*arguments);
        if (!complaint.empty()) throw CLI::ValidationError("--output", complaint);
        run = [arguments] { return ::run(*arguments); };
    });
}
