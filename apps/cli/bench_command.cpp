#include "command.h"
#include "interrupt.h"
#include "scan_arguments.h"
#include "terminal.h"

#include "relamp/bench.h"
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

void print(const relamp::BenchReport& report)
{
    fmt::print("{} texels, {} lights, {} shadow maps\n", report.texels, report.lights,
               report.shadowMaps);
    if (!report.gpu.empty())
        fmt::print("gpu  {}: copies {:.1f} GB/s, computes {:.0f} GFLOP/s\n", report.gpu,
                   1e-9 * report.bytesPerSecond, 1e-9 * report.flopsPerSecond);
    fmt::print("cpu  {}\n\n", report.cpu);
    const auto row = [](const std::string& a, const std::string& b, const std::string& c,
                        const std::string& d) {
        fmt::print("{:<9}{:>11}{:>11}{:>11}\n", a, b, c, d);
    };
    row("", "gpu, ms", "floor, ms", "cpu, ms");
    for (const relamp::StageTime& stage : report.stages)
        row(stage.stage, cell(stage.gpu), cell(stage.floor), cell(stage.cpu));
    const relamp::StageTime total = report.total();
    row(total.stage, cell(total.gpu), cell(total.floor), cell(total.cpu));
    fmt::print("Choi 2018, table 1: 36.06 ms on a GTX 1080 Ti\n");
}

int run(const BenchArguments& arguments)
{
    relamp::Progress progress(progressDisplay(Talk::normal));
    const Interrupt interrupt(progress);
    const relamp::ThreadLimit threads(arguments.scan.threads);
    const relamp::Scan scan =
        relamp::readScan(arguments.scan.file, arguments.scan.options, progress);
    const relamp::BenchReport report = relamp::measureFrame(scan, arguments.options, progress);
    endProgressDisplay(Talk::normal);
    print(report);
    return 0;
}

} // namespace

void addBenchCommand(CLI::App& app, Run& run)
{
    CLI::App& command = *app.add_subcommand(
        "bench", "Time a frame of the thesis solver on a scan, stage by stage, on GPU and CPU");
    const auto arguments = std::make_shared<BenchArguments>();
    addScanArguments(command, arguments->scan);
    addEngineArguments(command, arguments->options.engine);
    command
        .add_option("--rounds", arguments->options.rounds, "Frames, of which the best counts [5]")
        ->check(between(1, 1000))
        ->type_name("N");
    command.footer("Example:\n  relamp bench kitchen.glb --gpu 0");
    command.callback([arguments, &run] { run = [arguments] { return ::run(*arguments); }; });
}
