#include "command.h"
#include "interrupt.h"
#include "scan_arguments.h"
#include "terminal.h"

#include "bench/stage_times.h"
#include "relamp/threads.h"

#include <memory>

#include <fmt/format.h>

namespace
{

struct BenchArguments
{
    ScanArguments scan;
    relamp::BenchOptions options;
};

/// Milliseconds, or nothing where there is no time.
std::string cell(double seconds)
{
    return seconds > 0.0 ? fmt::format("{:.2f}", 1e3 * seconds) : "";
}

void print(const relamp::StageTimes& times)
{
    const auto row = [](const std::string& a, const std::string& b, const std::string& c,
                        const std::string& d) {
        printOut("{:<9}{:>11}{:>11}{:>11}\n", a, b, c, d);
    };
    row("", "gpu, ms", "floor, ms", "cpu, ms");
    for (const relamp::StageTime& stage : times.stages)
        row(stage.stage, cell(stage.gpu), cell(stage.floor), cell(stage.cpu));
    const relamp::StageTime total = times.total();
    row(total.stage, cell(total.gpu), cell(total.floor), cell(total.cpu));
}

void print(const relamp::BenchReport& report)
{
    if (!report.gpu.empty())
        printOut("gpu  {}: copies {:.1f} GB/s, computes {:.0f} GFLOP/s\n", report.gpu,
                 1e-9 * report.bytesPerSecond, 1e-9 * report.flopsPerSecond);
    printOut("cpu  {}\n", report.cpu);

    printOut("\nA frame of the thesis: {} texels, {} lights, {} shadow maps\n", report.frame.texels,
             report.frame.lights, report.frame.shadowMaps);
    print(report.frame);
    printOut("Choi 2018, table 1: 36.06 ms on a GTX 1080 Ti\n");

    const relamp::ReevaluateTimes& reevaluate = report.reevaluate;
    printOut("\nThe gather solver after a lamp's power changed: {} texels, {} lamps, {} surfels, "
             "{} rays\n",
             reevaluate.texels, reevaluate.lamps, reevaluate.surfels, reevaluate.rays);
    print(reevaluate);
    if (reevaluate.once > 0.0)
        printOut("Before, once: {:.2f} ms on the GPU for each lamp on each texel\n",
                 1e3 * reevaluate.once);
}

int run(const BenchArguments& arguments)
{
    relamp::Progress progress(progressDisplay(Talk::normal));
    const Interrupt interrupt(progress);
    const relamp::ThreadLimit threads(arguments.scan.threads);
    relamp::checkDevice(arguments.options.engine);
    const relamp::Scan scan =
        relamp::readScan(arguments.scan.file, arguments.scan.options, progress);
    const relamp::BenchReport report = relamp::measureStages(scan, arguments.options, progress);
    endProgressDisplay(Talk::normal);
    print(report);
    return 0;
}

} // namespace

void addBenchCommand(CLI::App& app, Run& run)
{
    CLI::App& command = *app.add_subcommand(
        "bench", "Time a frame of the thesis solver, and the gather solver after a lamp's power "
                 "changed, stage by stage, on GPU and CPU");
    const auto arguments = std::make_shared<BenchArguments>();
    addScanArguments(command, arguments->scan);
    addEngineArguments(command, arguments->options.engine, "the stages");
    command
        .add_option("--rounds", arguments->options.rounds, "Frames, of which the best counts [5]")
        ->check(between(1, 1000))
        ->type_name("N");
    command.footer("Example:\n  relamp bench kitchen.glb --gpu 0");
    command.callback([arguments, &run] { run = [arguments] { return ::run(*arguments); }; });
}
