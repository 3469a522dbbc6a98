#include "camera_words.h"
#include "command.h"
#include "draft.h"
#include "interrupt.h"
#include "place_arguments.h"
#include "room_page.h"
#include "scan_arguments.h"
#include "terminal.h"
#include "unexpected.h"

#include "relamp/delight.h"
#include "relamp/error.h"
#include "relamp/page.h"
#include "relamp/result.h"
#include "relamp/threads.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>

namespace
{

constexpr size_t kMostListed = 12;            // lamps in the summary
constexpr const char* kStraight = "straight"; // --response of a camera that applied no curve
constexpr const char* kGatherGroup = "Parameters of the gather solver (it needs none)";
constexpr const char* kPathtraceGroup =
    "Parameters of the pathtrace solver (and those of the gather solver)";
constexpr const char* kThesisGroup =
    "Parameters of the thesis solver (what is not given follows from the scan)";

struct DelightArguments
{
    std::vector<std::filesystem::path> scans;
    ScanArguments scan; // the one that is worked on
    relamp::DelightOptions options;
    relamp::ResultOptions files;
    std::filesystem::path folder;
    std::filesystem::path lights;
    std::string response;
    std::vector<float> attenuation;
    bool quiet = false;
    bool json = false;
    bool progress = false;
    bool force = false;
    bool page = false;
};

void addThesisParameters(CLI::App& command, DelightArguments& arguments)
{
    relamp::ThesisOptions& parameters = arguments.options.thesis;
    command
        .add_option("--emitter-threshold", parameters.emitterThreshold,
                    "Luminance from which a burnt-out texel is taken to shine [0.9]")
        ->check(between(0.0, 1.0))
        ->type_name("L")
        ->group(kThesisGroup);
    command
        .add_option("--expansion", parameters.expansion,
                    "Radiance of white once the range is expanded [8]")
        ->check(between(1.0, 1e4))
        ->type_name("L")
        ->group(kThesisGroup);
    command.add_option("--light-levels", parameters.lightLevels, "2^N lights by median cut [6]")
        ->check(between(0, 10))
        ->type_name("N")
        ->group(kThesisGroup);
    command
        .add_option("--attenuation", arguments.attenuation,
                    "k0 k1 k2 of 1 / (k0 + k1 d + k2 d^2), d in metres")
        ->expected(3)
        ->check(between(0.0, 1e6))
        ->type_name("K")
        ->group(kThesisGroup);
    command.add_option("--power", parameters.power, "Factor on all light")
        ->check(between(1e-6, 1e6))
        ->type_name("X")
        ->group(kThesisGroup);
    command.add_option("--ambient", parameters.ambient, "Ambient light, irradiance / pi")
        ->check(between(0.0, 1e6))
        ->type_name("L")
        ->group(kThesisGroup);
    command
        .add_option("--merge-distance", parameters.mergeDistance,
                    "Lights nearer than this share a shadow map")
        ->check(between(0.0, 1e6))
        ->type_name("M")
        ->group(kThesisGroup);
    command
        .add_option("--rsm-size", parameters.rsmSize,
                    "Pixels along a face of a reflective shadow map [32]")
        ->check(between(8, 512))
        ->type_name("N")
        ->group(kThesisGroup);
    command
        .add_option("--lpv-size", parameters.lpvSize,
                    "Cells of the light propagation volume along the room [32]")
        ->check(between(8, 128))
        ->type_name("N")
        ->group(kThesisGroup);
    command.add_option("--lpv-steps", parameters.lpvSteps, "Propagation steps [8]")
        ->check(between(1, 128))
        ->type_name("N")
        ->group(kThesisGroup);
    command
        .add_option("--flatten-reach", parameters.flattenReach,
                    "Reach of the bilateral filter, in pieces of surface [1.5]")
        ->check(between(1.0, 2.0))
        ->type_name("X")
        ->group(kThesisGroup);
    command
        .add_option("--flatten-range", parameters.flattenRange,
                    "Range of the bilateral filter in square roots of radiance [0.2]")
        ->check(between(0.01, 10.0))
        ->type_name("X")
        ->group(kThesisGroup);
    command
        .add_flag_callback(
            "--no-lpv", [&parameters] { parameters.useLpv = false; }, "No bounce light")
        ->group(kThesisGroup);
    command
        .add_flag_callback(
            "--no-ambient", [&parameters] { parameters.useAmbient = false; }, "No ambient light")
        ->group(kThesisGroup);
}

void addGatherParameters(CLI::App& command, DelightArguments& arguments)
{
    relamp::GatherOptions& gather = arguments.options.gather;
    command
        .add_option(
            "--quality", gather.quality,
            "draft for a first look, on textures of 512 pixels, where a small lamp may be missed; "
            "standard; or high: four times the rays [standard]")
        ->transform(oneOf<relamp::Quality>())
        ->type_name("NAME")
        ->group(kGatherGroup);
    const auto addToGroup = [&](const char* name, auto& places, const char* what) {
        addPlaces(command, name, places, what).group(kGatherGroup);
    };
    addToGroup("--light", gather.lights,
               "What is burnt out or bright at this place, in metres, is a lamp (repeatable)");
    addToGroup("--not-a-light", gather.notLights,
               "What is burnt out or glows at this place is no lamp (repeatable)");
    addToGroup("--same", gather.same,
               "The surfaces at these two places are of one paint (repeatable)");
    addToGroup("--white", gather.white,
               "The surface at this place is white, as paper is: the scale of albedo (repeatable)");
    command
        .add_flag_callback(
            "--no-sun", [&gather] { gather.sun = false; }, "Look for no sun")
        ->group(kGatherGroup);
    command
        .add_option("--response", arguments.response,
                    "The camera's contrast curve, where it is known: straight, if the texture is "
                    "proportional to light, or that of a lights.json or report.json of another "
                    "scan by it [looked for]")
        ->type_name("straight|FILE")
        ->group(kGatherGroup);
    command
        .add_flag_callback(
            "--no-gain", [&gather] { gather.gain = false; },
            "Look for no drift of exposure or white balance, nor local tone mapping")
        ->group(kGatherGroup);
    command
        .add_option(
            "--rays", gather.rays,
            "Rays from every small piece of surface that look for bounce light [by quality]")
        ->check(between(4, 1024))
        ->type_name("N")
        ->group(kGatherGroup);
    command
        .add_option("--shadow-rays", gather.shadowRays,
                    "Rays of a place in a half shadow (penumbra) to each lamp [by quality]")
        ->check(between(1, 1024))
        ->type_name("N")
        ->group(kGatherGroup);
    command
        .add_option_function<uint32_t>(
            "--seed",
            [&options = arguments.options](uint32_t seed) {
                options.gather.seed = options.pathtrace.seed = seed;
            },
            "Of where rays start and go, and of the pathtrace solver's random numbers [1]")
        ->check(between(0, 4294967295.0))
        ->type_name("N")
        ->group(kGatherGroup);
}

void addPathtraceParameters(CLI::App& command, relamp::PathtraceOptions& pathtrace)
{
    command.add_option("--samples", pathtrace.samples, "Paths from every texel [64]")
        ->check(between(1, 65536))
        ->type_name("N")
        ->group(kPathtraceGroup);
}

/// Refuses what would change nothing: a person means something by every option.
void refuseWhatHasNoEffect(CLI::App& command, relamp::Solver solver, bool areLightsGiven)
{
    constexpr std::array kOfSearch{"--light",  "--not-a-light", "--same",   "--white",
                                   "--no-sun", "--response",    "--no-gain"};
    const bool isThesis = solver == relamp::Solver::thesis;
    for (const CLI::Option* option : command.get_options()) {
        if (option->count() == 0) continue;
        const std::string name = option->get_name();
        const std::string& group = option->get_group();
        const bool isOfOther = group == kGatherGroup   ? isThesis && name != "--quality"
                               : group == kThesisGroup ? !isThesis
                                                       : group == kPathtraceGroup &&
                                                             solver != relamp::Solver::pathtrace;
        if (isOfOther)
            throw CLI::ValidationError(
                name, fmt::format("the {} solver has no use for it, so that it would change "
                                  "nothing; leave it out, or take another --solver",
                                  relamp::nameOf(solver)));
        if (areLightsGiven &&
            std::find(kOfSearch.begin(), kOfSearch.end(), name) != kOfSearch.end())
            throw CLI::ValidationError(
                "--lights", fmt::format("nothing is estimated where the lights are given, so that "
                                        "{} would change nothing; leave it out, or --lights",
                                        name));
    }
}

/// What the camera did and what no lamp explains, as far as anything was found.
std::string cameraLine(const relamp::CameraModel& camera)
{
    const std::string did = deedsOf(camera);
    const std::string rest = unexplainedBy(camera);
    std::string line;
    if (!did.empty()) line += fmt::format("  camera: {}; taken out of the albedo\n", did);
    if (!rest.empty())
        line += fmt::format("  what no lamp explains: {}; taken out of the albedo\n", rest);
    return line;
}

/// What can be told without the truth.
std::string closingLine(const relamp::CrossValidation& validation)
{
    if (validation.pairs == 0)
        return "too few places look like one paint to tell whether the albedo is better than the "
               "scan\n";
    return fmt::format("places of one paint differ by {:.2f} stops in the scan and by {:.2f} in "
                       "the albedo, a gain of {:.1f} dB\n",
                       validation.scan, validation.albedo, validation.gain());
}

void printSummary(const DelightArguments& arguments, const relamp::Decomposition& result,
                  double seconds)
{
    const relamp::Scan& scan = *result.scan();
    const relamp::Lights& lights = result.lights();
    std::string text = fmt::format("{}: {} lamps and windows (fixtures in lights.json), {} point "
                                   "lights in the GLB, {} texels in {:.1f} s\n",
                                   arguments.scan.file.string(), lights.fixtures.size(),
                                   lights.points.size(), result.texelCount(), seconds);
    for (size_t i = 0; i < std::min(lights.fixtures.size(), kMostListed); ++i) {
        const glm::vec3 at = lights.fixtures[i].centre;
        text +=
            fmt::format("  {:<16} at {:.2f}, {:.2f}, {:.2f}\n", lights.nameOf(i), at.x, at.y, at.z);
    }
    if (lights.fixtures.size() > kMostListed)
        text += fmt::format("  and {} more in {}/lights.json\n",
                            lights.fixtures.size() - kMostListed, arguments.folder.string());
    text += cameraLine(lights.camera);
    text += fmt::format("{}/{}.glb is the room without its light; preview.png shows it as scanned, "
                        "albedo, shading\n",
                        arguments.folder.string(), scan.name);
    if (arguments.files.usd)
        text += fmt::format("{}/{}.usda is the same for programs that read USD\n",
                            arguments.folder.string(), scan.name);
    printAside(text);
    for (const std::string& warning : scan.warnings) printProblem("note: " + warning);
    for (const std::string& warning : result.warnings()) printProblem("note: " + warning);
    if (result.optionsInForce().solver != relamp::Solver::thesis)
        printAside(closingLine(result.crossValidation()));
}

relamp::PageOptions pageOptions(const DelightArguments& arguments)
{
    relamp::PageOptions page{.viewer = pageViewer()};
    if (arguments.force) page.replacing = relamp::Replacing::any;
    return page;
}

std::filesystem::path folderOfPage(const DelightArguments& arguments)
{
    return arguments.folder / "page";
}

/// The page of the result, for browsers, in a folder of its own. Returns what it lacks.
std::vector<std::string> writePage(const relamp::Decomposition& result,
                                   const DelightArguments& arguments, relamp::Progress& progress)
{
    const relamp::DelitRoom room = relamp::delitRoomOf(result, progress);
    relamp::Relighter relighter(room, {.engine = arguments.options.engine}, progress);
    return relamp::writePage(relighter, relamp::asCaptured(room.captured), folderOfPage(arguments),
                             pageOptions(arguments), progress)
        .notes;
}

int runOne(DelightArguments& arguments)
{
    const bool isSilent = arguments.quiet || arguments.json;
    const Talk talk = arguments.progress ? Talk::lines : isSilent ? Talk::quiet : Talk::normal;
    const auto start = std::chrono::steady_clock::now();
    relamp::Progress progress(progressDisplay(talk));
    const Interrupt interrupt(progress);
    const relamp::ThreadLimit threads(arguments.scan.threads);

    const auto replacing = arguments.force ? relamp::Replacing::any : relamp::Replacing::unchanged;
    relamp::checkOutput(arguments.scan.file, arguments.folder, replacing, arguments.files);
    relamp::checkDevice(arguments.options.engine);
    if (arguments.page) relamp::checkPage(folderOfPage(arguments), pageOptions(arguments));
    std::vector<std::string> notes;
    if (!arguments.lights.empty())
        arguments.options.lights = relamp::readLights(arguments.lights, notes);
    if (arguments.response == kStraight)
        arguments.options.gather.response = relamp::Response{};
    else if (!arguments.response.empty())
        arguments.options.gather.response = relamp::readResponse(arguments.response, notes);
    if (arguments.attenuation.size() == 3)
        arguments.options.thesis.attenuation = {arguments.attenuation[0], arguments.attenuation[1],
                                                arguments.attenuation[2]};

    if (arguments.options.gather.quality == relamp::Quality::draft)
        arguments.scan.options.longestSide = relamp::kDraftSide;
    relamp::Scan scan = relamp::readScan(arguments.scan.file, arguments.scan.options, progress);
    if (arguments.page) relamp::checkPage(scan);
    scan.warnings.insert(scan.warnings.end(), notes.begin(), notes.end());
    if (arguments.options.lights)
        arguments.options.fixtures =
            relamp::readFixturesBeside(arguments.lights, arguments.scan.file, scan);
    const relamp::Decomposition result =
        relamp::delight(std::move(scan), arguments.options, progress);
    const std::string report = relamp::writeResult(result, arguments.scan.file, arguments.folder,
                                                   progress, replacing, arguments.files);
    const std::vector<std::string> lacking =
        arguments.page ? writePage(result, arguments, progress) : std::vector<std::string>();
    endProgressDisplay(talk);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    if (arguments.json) printExactly(report); // endOutput tells whether it came
    if (isSilent) return 0;
    printSummary(arguments, result, elapsed.count());
    for (const std::string& note : lacking) printProblem("note: " + note);
    return 0;
}

/// The same of one of several, whose failure must not stop the others; false where it fails.
bool runOneOfSeveral(DelightArguments arguments, const std::filesystem::path& scan)
{
    arguments.scan.file = scan;
    arguments.folder /= scan.stem();
    try {
        return runOne(arguments) == 0;
    } catch (const relamp::Error& error) {
        if (error.code() == relamp::ErrorCode::cancelled) throw;
        endProgressDisplay(Talk::normal);
        printProblem(error.what());
    } catch (const std::exception& error) {
        endProgressDisplay(Talk::normal);
        printProblem(sentenceOf(error));
    }
    return false;
}

int run(DelightArguments& arguments)
{
    const std::vector<std::filesystem::path>& scans = arguments.scans;
    arguments.scan.file = scans.front();
    if (scans.size() == 1) return runOne(arguments);

    std::error_code failure;
    const bool isNew = std::filesystem::create_directories(arguments.folder, failure);
    if (failure)
        throw relamp::Error(relamp::ErrorCode::cannotWrite,
                            fmt::format("{}: cannot be made: {}; name another folder with -o",
                                        arguments.folder.string(), failure.message()));
    const auto done = std::count_if(scans.begin(), scans.end(), [&](const auto& scan) {
        return runOneOfSeveral(arguments, scan);
    });
    if (done == 0 && isNew) std::filesystem::remove(arguments.folder, failure); // it is empty
    const std::string all = fmt::format("{} of {} scans are done", done, scans.size());
    if (done == std::ssize(scans)) {
        if (!arguments.quiet) printAside(all + "\n");
        return 0;
    }
    printProblem(all + "; what is wrong with the others stands above");
    return 1;
}

/// What is about one scan, and folders that would be one.
void refuseWhatSeveralCannotHave(const CLI::App& command,
                                 const std::vector<std::filesystem::path>& scans)
{
    if (scans.size() == 1) return;
    for (const char* name : {"--light", "--not-a-light", "--same", "--white", "--lights", "--json"})
        if (command.count(name) > 0)
            throw CLI::ValidationError(name, "is about one scan; leave it out, or name one alone");
    std::error_code ignored;
    for (const std::filesystem::path& scan : scans)
        if (!std::filesystem::exists(scan, ignored)) // a word that was mistyped: begin nothing
            throw CLI::ValidationError("scan",
                                       fmt::format("{}: no such file; of several scans each has "
                                                   "to be there before any work is done",
                                                   scan.string()));
    std::map<std::filesystem::path, std::filesystem::path> byFolder;
    for (const std::filesystem::path& scan : scans) {
        const auto [other, isNew] = byFolder.emplace(scan.stem(), scan);
        if (!isNew)
            throw CLI::ValidationError(
                "scan", fmt::format("{} and {} would go into one folder, {}; rename one, or take "
                                    "them one by one",
                                    other->second.string(), scan.string(), scan.stem().string()));
    }
}

} // namespace

void addDelightCommand(CLI::App& app, Run& run)
{
    CLI::App& command = *app.add_subcommand(
        "delight", "Take the light out of a scan: albedo, lights, relightable GLB");
    const auto arguments = std::make_shared<DelightArguments>();
    command
        .add_option("scan", arguments->scans,
                    "glTF, GLB, OBJ, PLY, or what else Assimp reads; of several each goes into "
                    "DIR/<its name>, and one that is broken does not stop the others")
        ->required()
        ->type_name("SCAN");
    addReadingArguments(command, arguments->scan);
    command
        .add_option("-o,--output", arguments->folder,
                    "Folder for the result; made if it is not there")
        ->required()
        ->type_name("DIR");
    command
        .add_option("--solver", arguments->options.solver,
                    "How the shading is found: gather, pathtrace (slow, the reference), or thesis "
                    "(Choi 2018) [gather]")
        ->transform(oneOf<relamp::Solver>())
        ->type_name("NAME");
    command
        .add_option("--lights", arguments->lights,
                    "Use the lights of this lights.json instead of finding them")
        ->type_name("FILE");
    command
        .add_option("--darkest", arguments->options.albedo.darkest,
                    "Shading below this is believed the less the darker it is [0.005]")
        ->check(between(1e-6, 1.0))
        ->type_name("L");
    command.add_flag("--fill", arguments->options.albedo.fill,
                     "Give what is unlit the albedo of the surface around it (thesis solver: "
                     "what is burnt out too)");
    addEngineArguments(command, arguments->options.engine,
                       "the light of lamps once they are found, and the thesis solver");
    command.add_flag("--usd", arguments->files.usd,
                     "Also write the room as <scan>.usda, with its lamps as lights, and what "
                     "shines as emission.exr");
    command.add_flag("--page", arguments->page,
                     "Also write DIR/page, the room for browsers, as relamp page does");
    command.add_flag("--force", arguments->force,
                     "Replace files of DIR that relamp did not write, or that were changed since");
    command.add_flag("-q,--quiet", arguments->quiet, "Say nothing but errors");
    command.add_flag("--progress", arguments->progress,
                     "Progress as lines on standard error, stage and per cent, for a program");
    command.add_flag("--json", arguments->json, "Print the report as JSON and nothing else");
    addGatherParameters(command, *arguments);
    addPathtraceParameters(command, arguments->options.pathtrace);
    addThesisParameters(command, *arguments);
    command.footer("Examples:\n"
                   "  relamp delight kitchen.glb -o kitchen\n"
                   "  relamp delight scan.obj --up z --scale 0.01 -o out\n"
                   "  relamp delight scans/*.glb -o results\n"
                   "  relamp delight kitchen.glb -o again --lights kitchen/lights.json");
    command.callback([arguments, &command, &run] {
        refuseWhatHasNoEffect(command, arguments->options.solver, !arguments->lights.empty());
        refuseWhatSeveralCannotHave(command, arguments->scans);
        run = [arguments] { return ::run(*arguments); };
    });
}
