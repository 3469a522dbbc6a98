#include "scan_arguments.h"
#include "unexpected.h"
#include "viewer.h"

#include "relamp/error.h"
#include "relamp/printable.h"
#include "relamp/version.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

#include "relamp/threads.h"

#include <CLI/CLI.hpp>

namespace
{

constexpr int kWorldIsWrong = 1;
constexpr int kUsage = 2;

int sayWhatIsWrong(const std::string& sentence)
{
    std::fprintf(stderr, "relamp: %s\n", relamp::printableText(sentence).c_str());
    return kWorldIsWrong;
}

/// Reads "1280x720"; returns what is wrong with it.
std::string takeSize(const std::string& text, Viewer::Options& options)
{
    constexpr int kSmallest = 64; // pixels
    constexpr int kLargest = 16384;
    glm::ivec2 size(0);
    char rest = 0;
    const int read = std::sscanf(text.c_str(), "%5dx%5d%c", &size.x, &size.y, &rest);
    if (read != 2 || std::min(size.x, size.y) < kSmallest || std::max(size.x, size.y) > kLargest)
        return text + " is no size like 1280x720, from 64 to 16384 pixels each way";
    options.size = size;
    return "";
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Takes the light out of a room before your eyes, and lets you put up lamps in it.",
                 "relamp view");
    app.set_version_flag("--version", std::string("relamp ") + relamp::version());
    app.get_formatter()->column_width(34);
    ScanArguments scan;
    addScanArguments(app, scan);
    app.get_option("scan")->required(false)->description(
        "A scan, or the folder that relamp delight wrote; or drop one in later");
    Viewer::Options options;
    app.add_option("--size", "Of the window, in pixels [as it was last]")
        ->check(
            CLI::Validator([&options](std::string& text) { return takeSize(text, options); }, ""))
        ->type_name("WxH");
    addEngineArguments(
        app, options.engine,
        "the light of lamps once they are found, the thesis solver, and bounces of new "
        "light");
    const std::map<std::string, Smooth> smooth{
        {"auto", Smooth::automatic}, {"on", Smooth::on}, {"off", Smooth::off}};
    app.add_option("--smooth", options.smooth,
                   "Smooth edges: on, off, or auto: on a graphics card [auto]")
        ->transform(oneOf(smooth))
        ->type_name("WHEN");
    app.add_option("--script", options.script,
                   "Lines of commands that drive it instead of a person")
        ->type_name("FILE");
    app.footer("Examples:\n"
               "  relamp view kitchen.glb\n"
               "  relamp view kitchen\n"
               "  xvfb-run relamp view kitchen.glb --script pictures.txt");
    refuseEmptyValues(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        std::ostringstream complaint;
        if (app.exit(error, std::cout, complaint) == 0) return 0;
        sayWhatIsWrong(complaint.str());
        return kUsage;
    }
    options.path = scan.file;
    options.scan = scan.options;
    try {
        const relamp::ThreadLimit threads(scan.threads);
        // First what is to draw, too: no --engine does without that.
        if (!options.engine.gpu.empty()) static_cast<void>(relamp::gpuDevice(options.engine.gpu));
        relamp::checkDevice(options.engine);
        Viewer viewer(options);
        viewer.run();
        return 0;
    } catch (const relamp::Error& error) {
        return sayWhatIsWrong(error.what());
    } catch (const std::exception& error) {
        return sayWhatIsWrong(sentenceOf(error));
    }
}
