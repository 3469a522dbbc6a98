#include "command.h"
#include "interrupt.h"
#include "scan_arguments.h"
#include "terminal.h"

#include "relamp/threads.h"
#include "relamp/verify.h"

#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace
{

struct VerifyArguments
{
    std::filesystem::path folder;
    relamp::VerifyOptions options;
    int threads = 0;
    bool json = false;
};

nlohmann::ordered_json asJson(const VerifyArguments& arguments, const relamp::Verification& found)
{
    using nlohmann::ordered_json;
    ordered_json bins = ordered_json::array();
    for (const relamp::VerifiedBin& bin : found.bins)
        bins.push_back(
            {{"shading", bin.shading}, {"ratio", bin.ratio}, {"rmsError", bin.rmsError}});
    return {{"folder", arguments.folder.string()},
            {"scan", found.scanFile.string()},
            {"fixtures", found.fixtures},
            {"samples", arguments.options.samples},
            {"seed", arguments.options.seed},
            {"places", found.places},
            {"rmsError", found.rmsError},
            {"standardError", found.standardError},
            {"rmsOfScan", found.rmsOfScan},
            {"asWhiteAsPaper", found.asWhiteAsPaper},
            {"rmsErrorElsewhere", found.rmsErrorElsewhere},
            {"psnr", found.psnr},
            {"ratio", {found.ratio.r, found.ratio.g, found.ratio.b}},
            {"bins", std::move(bins)},
            {"warnings", found.warnings}};
}

void print(const VerifyArguments& arguments, const relamp::Verification& found)
{
    printOut("{}: albedo x light against {}\n", arguments.folder.string(), found.scanFile.string());
    printOut("  lights    {}\n",
             found.fixtures.empty() ? "none" : fmt::format("{}", fmt::join(found.fixtures, ", ")));
    printOut("  places    {} that are not burnt out, {} paths each\n", found.places,
             arguments.options.samples);
    printOut("  error     {:.4f} +- {:.4f} rms, {:.1f} dB; the scan's own rms is {:.3f}\n",
             found.rmsError, found.standardError, found.psnr, found.rmsOfScan);
    printOut("  too white {:.1f} % of the area is as white as paint can be (0.87 or more): of the "
             "light found, too little comes there; elsewhere the error is {:.4f} rms\n",
             100.0f * found.asWhiteAsPaper, found.rmsErrorElsewhere);
    printOut("  ratio     {:.3f} {:.3f} {:.3f} of what the scan shows (r g b)\n", found.ratio.r,
             found.ratio.g, found.ratio.b);
    printOut(
        "  by light  the compared area in five parts, from where little light falls to much\n");
    for (const relamp::VerifiedBin& bin : found.bins)
        printOut("            shading {:.3f}: ratio {:.3f}, error {:.4f} rms\n", bin.shading,
                 bin.ratio, bin.rmsError);
    for (const std::string& warning : found.warnings) printProblem("note: " + warning);
}

int run(const VerifyArguments& arguments)
{
    const Talk talk = arguments.json ? Talk::quiet : Talk::normal;
    relamp::Progress progress(progressDisplay(talk));
    const Interrupt interrupt(progress);
    const relamp::ThreadLimit threads(arguments.threads);
    const relamp::Verification found =
        relamp::verify(arguments.folder, arguments.options, progress);
    endProgressDisplay(talk);
    if (arguments.json)
        printExactly(asJson(arguments, found)
                         .dump(1, '\t', false, nlohmann::json::error_handler_t::replace) +
                     "\n");
    else
        print(arguments, found);
    return 0;
}

} // namespace

void addVerifyCommand(CLI::App& app, Run& run)
{
    CLI::App& command = *app.add_subcommand(
        "verify", "Render what delight wrote, every bounce simulated, and compare with the scan");
    const auto arguments = std::make_shared<VerifyArguments>();
    relamp::VerifyOptions& options = arguments->options;
    command.add_option("folder", arguments->folder, "What relamp delight was given as -o")
        ->required()
        ->type_name("DIR");
    command.add_option("--scan", options.scan, "Where the scan is, if it was moved")
        ->type_name("FILE");
    command.add_flag("--allow-outside", options.allowOutside,
                     "Let the scan name files outside of its folder");
    command.add_option("--samples", options.samples, "Paths from every place [64]")
        ->check(between(2, 65536))
        ->type_name("N");
    command.add_option("--places", options.places, "Texels to look at [20000]")
        ->check(between(1, 1e9))
        ->type_name("N");
    command.add_option("--seed", options.seed, "Of the random numbers [1]")
        ->check(between(0, 4294967295.0))
        ->type_name("N");
    command
        .add_option("--threads", arguments->threads, "Threads to work with; 0 is one a core [0]")
        ->check(between(0, 1024))
        ->type_name("N");
    command.add_flag("--json", arguments->json, "Print JSON and nothing else");
    command.footer("Example:\n  relamp verify kitchen");
    command.callback([arguments, &run] { run = [arguments] { return ::run(*arguments); }; });
}
