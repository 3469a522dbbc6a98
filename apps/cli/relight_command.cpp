#include "command.h"
#include "interrupt.h"
#include "scan_arguments.h"
#include "terminal.h"

#include "relamp/relight.h"
#include "relamp/threads.h"

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace
{

struct RelightArguments
{
    ScanArguments room; // a folder of delight's, or a scan whose texture is an albedo
    relamp::DelitOptions delit;
    relamp::RelightOptions options;
    relamp::ViewOptions view;
    std::filesystem::path lights;
    std::vector<std::string> fixtures;
    std::filesystem::path output;
    bool bake = false;
    bool keepNothing = false;
    bool quiet = false;
};

relamp::Relighting lightingOf(const RelightArguments& arguments, const relamp::Lights& captured,
                              std::vector<std::string>& warnings)
{
    relamp::Relighting lighting =
        arguments.lights.empty() ? relamp::darkened(captured)
                                 : relamp::readRelighting(arguments.lights, captured, warnings);
    for (const std::string& setting : arguments.fixtures)
        relamp::setFixture(lighting, captured, setting);
    return lighting;
}

int run(RelightArguments& arguments)
{
    const Talk talk = arguments.quiet ? Talk::quiet : Talk::normal;
    const auto start = std::chrono::steady_clock::now();
    relamp::Progress progress(progressDisplay(talk));
    const Interrupt interrupt(progress);
    const relamp::ThreadLimit threads(arguments.room.threads);

    arguments.delit.asScan = arguments.room.options;
    const relamp::DelitRoom room =
        relamp::readDelitRoom(arguments.room.file, arguments.delit, progress);
    std::vector<std::string> notes = room.warnings;
    const relamp::Relighting lighting = lightingOf(arguments, room.captured, notes);
    if (!arguments.keepNothing) arguments.options.transport = room.transport;
    relamp::Relighter relighter(room, arguments.options, progress);
    relighter.light(lighting, progress);
    relamp::writeBaked(relighter, arguments.output, arguments.view, progress);

    endProgressDisplay(talk);
    notes.insert(notes.end(), relighter.warnings().begin(), relighter.warnings().end());
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    if (talk == Talk::quiet) return 0;
    fmt::print("{}: {} in {:.1f} s\n", arguments.room.file.string(), arguments.output.string(),
               elapsed.count());
    for (const std::string& note : notes) printProblem("note: " + note);
    return 0;
}

void addSolverOptions(CLI::App& command, relamp::RelightOptions& options)
{
    const std::map<std::string, relamp::Solver> solvers{{"gather", relamp::Solver::gather},
                                                        {"pathtrace", relamp::Solver::pathtrace},
                                                        {"thesis", relamp::Solver::thesis}};
    command
        .add_option("--solver", options.solver,
                    "gather (shadows and radiosity), pathtrace (slow, the reference), or thesis "
                    "(no shadows, one bounce) [gather]")
        ->transform(CLI::CheckedTransformer(solvers).description(""))
        ->type_name("NAME");
    command
        .add_option("--rays", options.rays,
                    "Rays of a surfel that look for bounce light [by their number]")
        ->check(between(4, 1024))
        ->type_name("N");
    command
        .add_option("--shadow-rays", options.shadowRays,
                    "Rays of a texel in a penumbra to each light [16]")
        ->check(between(1, 1024))
        ->type_name("N");
    command.add_option("--samples", options.pathtrace.samples, "Paths from every texel [64]")
        ->check(between(1, 65536))
        ->type_name("N");
    command.add_option("--seed", options.pathtrace.seed, "Of the paths' random numbers [1]")
        ->check(between(0, 4294967295.0))
        ->type_name("N");
}

void addLightOptions(CLI::App& command, RelightArguments& arguments)
{
    command
        .add_option("--lights", arguments.lights,
                    "The new light: a lights file (docs/guide/lights.md)")
        ->type_name("FILE");
    command
        .add_option("--fixture", arguments.fixtures,
                    "N=on, N=off, N=50%, N=2700K,800lm, N=window, for fixture N of lights.json or "
                    "all; they are off otherwise (repeatable)")
        ->type_name("N=WHAT")
        ->allow_extra_args(false);
    command
        .add_option("--albedo", arguments.delit.albedo,
                    "Pictures to take for the room's albedo, one a page")
        ->type_name("FILE");
    command.add_option("--scan", arguments.delit.scan, "Where the scan is, if it was moved")
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
                    "With --bake: radiance.exr, one a page, or a model, baked.glb")
        ->required()
        ->type_name("FILE");
    command.add_flag("--bake", arguments->bake, "Bake the light into textures")->required();
    addLightOptions(command, *arguments);
    command
        .add_option("--exposure", arguments->view.exposure,
                    "Stops that a baked model is brighter than the light [0]")
        ->check(between(-32.0, 32.0))
        ->type_name("EV");
    addSolverOptions(command, arguments->options);
    command.add_flag("--no-transport", arguments->keepNothing,
                     "Neither read nor write DIR/transport.bin");
    command.add_flag("-q,--quiet", arguments->quiet, "Say nothing but errors");
    command.footer("Examples:\n"
                   "  relamp relight kitchen --lights lamp.json --bake -o radiance.exr\n"
                   "  relamp relight kitchen --fixture all=on --fixture 2=off --bake -o baked.glb");
    command.callback([arguments, &run] { run = [arguments] { return ::run(*arguments); }; });
}
