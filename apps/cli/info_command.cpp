#include "command.h"
#include "interrupt.h"
#include "scan_arguments.h"
#include "terminal.h"

#include "relamp/inspect.h"
#include "relamp/threads.h"

#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace
{

struct InfoArguments
{
    ScanArguments scan;
    bool json = false;
};

nlohmann::ordered_json asJson(const relamp::Inspection& found)
{
    using nlohmann::ordered_json;
    ordered_json pages = ordered_json::array();
    for (const relamp::PageInspection& page : found.pages)
        pages.push_back({{"name", page.name},
                         {"width", page.width},
                         {"height", page.height},
                         {"ofVertices", page.ofVertices},
                         {"coverage", page.coverage},
                         {"clipped", page.clipped},
                         {"charts", page.charts}});
    const glm::vec3 extent = found.bounds.extent();
    return {{"triangles", found.triangles},
            {"meshes", found.meshes},
            {"texels", found.texels},
            {"squareMetres", found.squareMetres},
            {"millimetresPerTexel", found.millimetresPerTexel},
            {"extent", {extent.x, extent.y, extent.z}},
            {"overlapShare", found.overlap.share()},
            {"overlap",
             {{"tiled", found.overlap.tiled},
              {"mirrored", found.overlap.mirrored},
              {"copied", found.overlap.copied},
              {"opposite", found.overlap.opposite},
              {"alike", found.overlap.alike},
              {"meshes", found.overlap.meshes}}},
            {"pages", std::move(pages)},
            {"problems", found.problems}};
}

void print(const std::string& file, const relamp::Inspection& found)
{
    const glm::vec3 extent = found.bounds.extent();
    printOut("{}\n", file);
    printOut("  surface   {} triangles in {} meshes, {:.1f} m^2\n", found.triangles, found.meshes,
             found.squareMetres);
    printOut("  size      {:.2f} x {:.2f} x {:.2f} m (x, y up, z)\n", extent.x, extent.y, extent.z);
    printOut("  texels    {} covered, {:.1f} mm each, {:.2f} % overlapping\n", found.texels,
             found.millimetresPerTexel, 100.0 * found.overlap.share());
    for (size_t i = 0; i < found.pages.size(); ++i) {
        const relamp::PageInspection& page = found.pages[i];
        if (page.ofVertices)
            printOut("  texture {} vertex colours, {:.1f} % burnt out\n", i, 100.0 * page.clipped);
        else
            printOut(
                "  texture {} {} x {} \"{}\", {:.0f} % covered in {} pieces, {:.1f} % burnt out\n",
                i, page.width, page.height, relamp::printableName(page.name), 100.0 * page.coverage,
                page.charts, 100.0 * page.clipped);
    }
    for (const std::string& problem : found.problems) printOut("  note      {}\n", problem);
    if (found.problems.empty()) printOut("  fine      nothing stands in the way of delight\n");
}

int run(const InfoArguments& arguments)
{
    const Talk talk = arguments.json ? Talk::quiet : Talk::normal;
    relamp::Progress progress(progressDisplay(talk));
    const Interrupt interrupt(progress);
    const relamp::ThreadLimit threads(arguments.scan.threads);
    const relamp::Scan scan =
        relamp::readScan(arguments.scan.file, arguments.scan.options, progress);
    const relamp::Inspection found = relamp::inspect(scan, progress);
    endProgressDisplay(talk);
    if (arguments.json)
        printExactly(asJson(found).dump(1, '\t', false, nlohmann::json::error_handler_t::replace) +
                     "\n");
    else
        print(arguments.scan.file.string(), found);
    return 0;
}

} // namespace

void addInfoCommand(CLI::App& app, Run& run)
{
    CLI::App& command =
        *app.add_subcommand("info", "Tell what a scan is and what will be a problem");
    const auto arguments = std::make_shared<InfoArguments>();
    addScanArguments(command, arguments->scan);
    command.add_flag("--json", arguments->json, "Print JSON and nothing else");
    command.footer("Example:\n  relamp info kitchen.glb");
    command.callback([arguments, &run] { run = [arguments] { return ::run(*arguments); }; });
}
