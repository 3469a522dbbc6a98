#include "scan_arguments.h"
#include "viewer.h"

#include "relamp/error.h"
#include "relamp/version.h"

#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "relamp/threads.h"

#include <CLI/CLI.hpp>

namespace
{

constexpr int kWorldIsWrong = 1;
constexpr int kUsage = 2;

int sayWhatIsWrong(const std::string& sentence)
{
    std::fprintf(stderr, "relamp: %s\n", sentence.c_str());
    return kWorldIsWrong;
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
    std::vector<int> size;
    app.add_option("--size", size, "Of the window, in pixels [as it was last]")
        ->delimiter('x')
        ->type_size(2)
        ->expected(1)
        ->take_all()
        ->check(between(64, 16384))
        ->type_name("WxH");
    app.add_option("--script", options.script,
                   "Lines of commands that drive it instead of a person")
        ->type_name("FILE");
    app.footer("Examples:\n"
               "  relamp view kitchen.glb\n"
               "  relamp view kitchen\n"
               "  xvfb-run relamp view kitchen.glb --script pictures.txt");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : kUsage;
    }
    options.path = scan.file;
    options.scan = scan.options;
    if (size.size() == 2) options.size = glm::ivec2(size[0], size[1]);
    try {
        const relamp::ThreadLimit threads(scan.threads);
        Viewer viewer(options);
        viewer.run();
        return 0;
    } catch (const relamp::Error& error) {
        return sayWhatIsWrong(error.what());
    } catch (const std::bad_alloc&) {
        return sayWhatIsWrong("this machine has not enough memory for the scan");
    } catch (const std::exception& error) {
        return sayWhatIsWrong(error.what());
    }
}
