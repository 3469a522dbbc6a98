#include "command.h"
#include "interrupt.h"
#include "light_arguments.h"
#include "room_page.h"
#include "scan_arguments.h"
#include "terminal.h"

#include "relamp/page.h"
#include "relamp/picture.h"
#include "relamp/threads.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace
{

struct PageArguments
{
    ScanArguments room; // a folder of delight's
    relamp::RelightOptions relight;
    relamp::PageOptions page;
    LightArguments light;
    std::filesystem::path timeline;
    std::filesystem::path output;
    std::string camera = "auto";
    bool force = false;
    bool keepNothing = false;
    bool quiet = false;
};

int run(PageArguments& arguments)
{
    const Talk talk = arguments.quiet ? Talk::quiet : Talk::normal;
    const auto start = std::chrono::steady_clock::now();
    arguments.light.readPipe(); // before Ctrl-C is kept for the work
    relamp::Progress progress(progressDisplay(talk));
    const Interrupt interrupt(progress);
    const relamp::ThreadLimit threads(arguments.room.threads);
    relamp::checkDevice(arguments.relight.engine);
    relamp::PageOptions& page = arguments.page;
    page.viewer = pageViewer();
    page.scan.asScan = arguments.room.options;
    if (arguments.force) page.replacing = relamp::Replacing::any;
    relamp::checkPage(arguments.output, page);

    const relamp::DelitRoom room = relamp::readDelitRoom(arguments.room.file, page.scan, progress);
    std::vector<std::string> notes = room.warnings;
    if (arguments.camera != "auto")
        page.camera = relamp::cameraFor(arguments.camera, *room.scan, notes);
    const relamp::Relighting lighting =
        arguments.light.in(room.captured, relamp::asCaptured(room.captured), notes);
    std::optional<relamp::Timeline> timeline;
    if (!arguments.timeline.empty())
        page.timeline = &timeline.emplace(arguments.timeline, room.captured, notes);
    if (!arguments.keepNothing) arguments.relight.transport = room.transport;
    relamp::Relighter relighter(room, arguments.relight, progress);
    const relamp::WrittenPage written =
        relamp::writePage(relighter, lighting, arguments.output, page, progress);
    notes.insert(notes.end(), written.notes.begin(), written.notes.end());

    endProgressDisplay(talk);
    if (talk == Talk::quiet) return 0;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    printAside(fmt::format("{}: {}, {} lights, {:.1f} MB in {:.1f} s\n",
                           arguments.room.file.string(), (arguments.output / "index.html").string(),
                           written.lights, 1e-6 * static_cast<double>(written.bytes),
                           elapsed.count()));
    for (const std::string& note : notes) printProblem("note: " + note);
    return 0;
}

} // namespace

void addPageCommand(CLI::App& app, Run& run)
{
    CLI::App& command = *app.add_subcommand(
        "page", "Write a page for browsers in which a room's lamps can be switched");
    const auto arguments = std::make_shared<PageArguments>();
    addScanArguments(command, arguments->room);
    command.get_option("scan")->description("What relamp delight was given as -o");
    command.add_option("-o,--output", arguments->output, "The folder; open its index.html")
        ->required()
        ->type_name("DIR");
    addLightArguments(command, arguments->light, "Other lights than those of the room",
                      "A lamp or window otherwise than it was: N=off, N=50%, N=2700K,800lm");
    command
        .add_option("--timeline", arguments->timeline,
                    "Light that a visitor changes by a slider over time: lights as keys in time "
                    "(docs/guide/relighting.md)")
        ->type_name("FILE");
    command
        .add_option("--camera", arguments->camera,
                    "Where a visitor begins: auto, a number of the glTF file's own cameras, or a "
                    "camera file [auto]")
        ->type_name("CAMERA");
    command
        .add_option("--side", arguments->page.side,
                    "Pixels of a lightmap along a side, at most [1024; of many lights 512]")
        ->check(between(16, 4096))
        ->type_name("N");
    command.add_option("--scan", arguments->page.scan.scan, "Where the scan is, if it was moved")
        ->type_name("FILE");
    addEngineArguments(command, arguments->relight.engine, "bounces");
    command.add_flag("--no-transport", arguments->keepNothing,
                     "Neither read nor write DIR/transport.bin, which keeps where bounce light "
                     "goes, so that the next run is faster");
    command.add_flag("--force", arguments->force,
                     "Replace files of a folder that relamp did not write, or that were changed");
    command.add_flag("-q,--quiet", arguments->quiet, "Say nothing but errors");
    command.footer("Example:\n  relamp page kitchen -o kitchen_page");
    command.callback([arguments, &run] { run = [arguments] { return ::run(*arguments); }; });
}
