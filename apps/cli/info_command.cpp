#include "camera_words.h"
#include "command.h"
#include "draft.h"
#include "interrupt.h"
#include "scan_arguments.h"
#include "terminal.h"

#include "relamp/delight.h"
#include "relamp/error.h"
#include "relamp/estimate.h"
#include "relamp/inspect.h"
#include "relamp/threads.h"

#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace
{

struct InfoArguments
{
    ScanArguments scan;
    bool json = false;
};

/// What a draft tells of how the scan was taken.
struct FirstLook
{
    relamp::CameraModel camera;
    std::vector<relamp::Opening> openings;
    size_t fixtures = 0;
};

/// None of a scan that delight refuses; inspect() has said why.
std::optional<FirstLook> firstLookAt(const relamp::Scan& scan, relamp::Progress& progress)
{
    try {
        const relamp::Decomposition draft = draftOf(scan, progress);
        return FirstLook{draft.lights().camera, draft.openings(), draft.lights().fixtures.size()};
    } catch (const relamp::Error& error) {
        if (error.code() != relamp::ErrorCode::unsupported) throw;
        return std::nullopt;
    }
}

/// Of all texels.
double burntOut(const relamp::Inspection& found)
{
    double sum = 0.0;
    double all = 0.0;
    for (const relamp::PageInspection& page : found.pages) {
        const double texels = page.coverage * page.width * page.height;
        sum += texels * page.clipped;
        all += texels;
    }
    return all > 0.0 ? sum / all : 0.0;
}

std::string facing(glm::vec3 normal)
{
    if (normal.y < -0.5f) return "above";
    return normal.y > 0.5f ? "below" : "upright";
}

nlohmann::ordered_json vectorAsJson(glm::vec3 v)
{
    return {v.x, v.y, v.z};
}

nlohmann::ordered_json cameraAsJson(const relamp::CameraModel& camera)
{
    return {{"contrast", camera.response.contrast()},
            {"response", camera.response.slope},
            {"localExponent", camera.tone.exponent},
            {"gainStops", camera.stops()},
            {"drifted", camera.drifted}};
}

nlohmann::ordered_json openingsAsJson(const std::vector<relamp::Opening>& openings)
{
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const relamp::Opening& opening : openings)
        list.push_back({{"centre", vectorAsJson(opening.centre)},
                        {"normal", vectorAsJson(opening.normal)},
                        {"area", opening.area}});
    return list;
}

relamp::Estimate estimateOf(const relamp::Inspection& found, const std::optional<FirstLook>& look)
{
    return relamp::estimate(found, look ? look->fixtures : 0);
}

nlohmann::ordered_json estimateAsJson(const relamp::Estimate& estimate)
{
    const auto costAsJson = [](const relamp::Cost& cost) {
        return nlohmann::ordered_json{{"bytes", std::llround(cost.bytes)},
                                      {"coreSeconds", cost.coreSeconds}};
    };
    return {{"delight", costAsJson(estimate.delight)},
            {"verify", costAsJson(estimate.verify)},
            {"relight", costAsJson(estimate.relight)}};
}

nlohmann::ordered_json asJson(const relamp::Inspection& found, const std::optional<FirstLook>& look)
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
            {"centre", vectorAsJson(found.bounds.centre())},
            {"overlapShare", found.overlap.share()},
            {"overlap",
             {{"tiled", found.overlap.tiled},
              {"mirrored", found.overlap.mirrored},
              {"copied", found.overlap.copied},
              {"opposite", found.overlap.opposite},
              {"alike", found.overlap.alike},
              {"meshes", found.overlap.meshes}}},
            {"pages", std::move(pages)},
            {"burntOut", burntOut(found)},
            {"camera", look ? cameraAsJson(look->camera) : ordered_json()},
            {"openings", look ? openingsAsJson(look->openings) : ordered_json()},
            {"estimate", estimateAsJson(estimateOf(found, look))},
            {"problems", found.problems}};
}

std::string jsonText(const nlohmann::ordered_json& json)
{
    return json.dump(1, '\t', false, nlohmann::json::error_handler_t::replace) + "\n";
}

/// It seems so, for a draft is no proof.
void print(const FirstLook& look)
{
    const std::string did = deedsOf(look.camera);
    printOut("  camera    seems {}\n",
             did.empty() ? "to have left light as it is: no contrast curve, no drift of exposure"
                         : "to have changed light: " + did);
    for (const relamp::Opening& opening : look.openings)
        printOut("  opening   {:.1f} m^2 around {:.2f}, {:.2f}, {:.2f} ({})\n", opening.area,
                 opening.centre.x, opening.centre.y, opening.centre.z, facing(opening.normal));
    if (look.openings.empty()) printOut("  openings  none that are large\n");
}

void print(const std::string& file, const relamp::Inspection& found,
           const std::optional<FirstLook>& look)
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
    if (found.pages.size() > 1)
        printOut("  burnt out {:.1f} % of all texels\n", 100.0 * burntOut(found));
    if (look) print(*look);
    const relamp::Cost cost = estimateOf(found, look).delight;
    printOut("  delight   takes about {:.1f} GB of memory and {:.0f} s of a core\n",
             cost.bytes / 1e9, cost.coreSeconds);
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
    const std::optional<FirstLook> look = firstLookAt(scan, progress);
    endProgressDisplay(talk);
    if (arguments.json)
        printExactly(jsonText(asJson(found, look)));
    else
        print(arguments.scan.file.string(), found, look);
    return 0;
}

} // namespace

void addInfoCommand(CLI::App& app, Run& run)
{
    CLI::App& command = *app.add_subcommand(
        "info", "Tell what a scan is, what its camera seems to have done, where "
                "it has openings, and what will be a problem");
    const auto arguments = std::make_shared<InfoArguments>();
    addScanArguments(command, arguments->scan);
    command.add_flag("--json", arguments->json, "Print JSON and nothing else");
    command.footer("Example:\n  relamp info kitchen.glb");
    command.callback([arguments, &run] { run = [arguments] { return ::run(*arguments); }; });
}
