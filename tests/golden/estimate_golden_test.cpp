// What `relamp info` says that the commands take, against what they take of the sample.

#include "golden/program.h"
#include "golden/sample.h"
#include "relamp/estimate.h"
#include "scenes/temporary_folder.h"

#include <string>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace relamp::golden
{
namespace
{

using scenes::TemporaryFolder;

struct Taken
{
    double bytes = 0.0;       // of resident memory, at the peak
    double coreSeconds = 0.0; // user and system
};

/// Runs relamp and measures that process alone, whatever ran before.
Taken takenBy(const std::vector<std::string>& arguments)
{
    std::vector<std::string> words{RELAMP_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
        execv(RELAMP_PROGRAM, pointers.data());
        _exit(127);
    }
    int status = -1;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    EXPECT_EQ(status, 0) << arguments.front();
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return {1024.0 * static_cast<double>(usage.ru_maxrss),
            seconds(usage.ru_utime) + seconds(usage.ru_stime)};
}

/// Memory hardly depends on the machine. Its time does: where two threads share a core, or a disk
/// or cache is busy, the same work takes up to twice the core seconds; and processors differ.
void expectNear(const nlohmann::json& estimate, const Taken& taken, const std::string& command)
{
    const double bytes = estimate[command]["bytes"].get<double>() / taken.bytes;
    EXPECT_GT(bytes, 1 / 1.5) << command;
    EXPECT_LT(bytes, 1.5) << command;
    const double seconds = estimate[command]["coreSeconds"].get<double>() / taken.coreSeconds;
    EXPECT_GT(seconds, 1 / 3.0) << command;
    EXPECT_LT(seconds, 3.0) << command;
}

/// What delight took of a scan on 2026-11-27, of large ones and of sixteen rooms a day later
/// (docs/dev/notebook.md).
struct Measured
{
    const char* scan;
    Inspection sizes;
    size_t fixtures;
    double megabytes;
    double coreSeconds;
};

Inspection sized(size_t texels, size_t triangles, double squareMetres,
                 const std::vector<PageInspection>& pages)
{
    Inspection sizes;
    sizes.texels = texels;
    sizes.triangles = triangles;
    sizes.squareMetres = squareMetres;
    sizes.pages = pages;
    return sizes;
}

std::vector<Measured> measuredScans()
{
    const auto page = [](int width, int height, size_t charts) {
        return PageInspection{.width = width, .height = height, .charts = charts};
    };
    const auto pagesOf8192 = [&](size_t count) {
        return std::vector<PageInspection>(count, page(8192, 8192, 1900 / count));
    };
    const std::vector<PageInspection> sixteen(16, page(1024, 1024, 1831));
    return {{"a small room", sized(151969, 558, 53.8, {page(448, 448, 279)}), 3, 123, 2.27},
            {"meeting room", sized(4916430, 27560, 121.9, {page(2048, 3840, 80)}), 11, 603, 12.3},
            {"sample, 4096 pixels", sized(8716650, 39855, 87.2, {page(4096, 4096, 1831)}), 3, 1010,
             19.9},
            {"sample, sixteen times the triangles",
             sized(545268, 637680, 87.3, {page(1024, 1024, 1831)}), 3, 488, 24.51},
            {"sixteen rooms", sized(8724224, 637680, 1396.2, sixteen), 32, 1765, 177.0},
            {"eight pages of 8192 pixels", sized(263815297, 39855, 87.1, pagesOf8192(8)), 3, 3490,
             249.4},
            {"thirty-two pages of 8192 pixels", sized(993011552, 39855, 87.1, pagesOf8192(32)), 3,
             4090, 927.8}};
}

} // namespace

TEST(Estimate, IsWithinHalfOfWhatOtherScansTook)
{
    for (const Measured& measured : measuredScans()) {
        const Cost found = estimate(measured.sizes, measured.fixtures).delight;
        EXPECT_GT(found.bytes, 1e6 * measured.megabytes / 1.5) << measured.scan;
        EXPECT_LT(found.bytes, 1e6 * measured.megabytes * 1.5) << measured.scan;
        EXPECT_GT(found.coreSeconds, measured.coreSeconds / 1.5) << measured.scan;
        EXPECT_LT(found.coreSeconds, measured.coreSeconds) << measured.scan;
    }
}

// A building of a hundred copies of the sample: surfels are larger there, and not more.
TEST(Estimate, GrowsNoFurtherThanSurfelsDo)
{
    Inspection building = sized(54526400, 3985500, 8726.3, {});
    building.pages.assign(100, PageInspection{.width = 1024, .height = 1024, .charts = 1831});
    const Cost found = estimate(building, 200).delight;
    EXPECT_GT(found.bytes, 4.78e9 / 1.5);
    EXPECT_LT(found.bytes, 4.78e9 * 1.5);
    EXPECT_GT(found.coreSeconds, 539.0 / 1.5);
    EXPECT_LT(found.coreSeconds, 539.0 * 1.5);
}

TEST(EstimateProgram, IsWithinHalfOfWhatTheSampleTakes)
{
    const TemporaryFolder folder;
    const Outcome run = runRelamp({"info", kSampleScan, "--json"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const nlohmann::json estimate = nlohmann::json::parse(run.out)["estimate"];
    const std::string room = folder / "out";
    const std::vector<std::string> cpu{"--engine", "cpu", "--threads", "2"};
    const auto with = [&](std::vector<std::string> words) {
        words.insert(words.end(), cpu.begin(), cpu.end());
        return words;
    };
    expectNear(estimate, takenBy(with({"delight", kSampleScan, "-q", "-o", room})), "delight");
    expectNear(estimate,
               takenBy(with({"relight", room, "-q", "--fixture", "all=on", "--no-transport", "-o",
                             folder / "lit.png"})),
               "relight");
    expectNear(estimate, takenBy({"verify", room, "--threads", "2", "--json"}), "verify");
}

} // namespace relamp::golden
