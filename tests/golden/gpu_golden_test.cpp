// The GPU engine in the real program, on whatever device there is: Mesa's lavapipe will do.

#include "golden/program.h"
#include "golden/sample.h"
#include "golden/score.h"
#include "scenes/temporary_folder.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace relamp::golden
{
namespace
{

using scenes::TemporaryFolder;
using testing::HasSubstr;

/// Takes the light out of the sample into folder / engine.
void delightOn(const std::string& engine, const std::string& solver, const TemporaryFolder& folder)
{
    const Outcome run = runRelamp({"delight", kSampleScan, "-o", folder / engine, "--solver",
                                   solver, "--engine", engine, "-q"});
    EXPECT_EQ(run.exitCode, 0) << run.err;
}

/// Root of the mean squared difference of two pictures, as a share of the second.
double apart(const Picture& found, const Picture& expected)
{
    EXPECT_EQ(found.rgb.size(), expected.rgb.size());
    double apart = 0.0;
    double all = 0.0;
    for (size_t i = 0; i < expected.rgb.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const auto value = static_cast<double>(expected.rgb[i][c]);
            apart += std::pow(static_cast<double>(found.rgb[i][c]) - value, 2.0);
            all += value * value;
        }
    return std::sqrt(apart / all);
}

nlohmann::json reportOf(const std::filesystem::path& folder)
{
    return nlohmann::json::parse(std::ifstream(folder / "report.json"));
}

} // namespace

TEST(GpuProgram, ListsWhatThereIsToComputeOn)
{
    const Outcome run = runRelamp({"devices"});
    EXPECT_EQ(run.exitCode, 0);
    EXPECT_THAT(run.out, testing::StartsWith("cpu  "));
    EXPECT_THAT(run.out, HasSubstr("\n0    ")) << "no Vulkan device: install mesa-vulkan-drivers";
}

TEST(GpuProgram, GivesTheLayersThatTheCpuGives)
{
    for (const std::string solver : {"gather", "thesis"}) {
        const TemporaryFolder folder;
        delightOn("cpu", solver, folder);
        delightOn("gpu", solver, folder);
        for (const char* layer : {"albedo.exr", "direct.exr", "indirect.exr"})
            EXPECT_LT(
                apart(readPicture((folder / "gpu") / layer), readPicture((folder / "cpu") / layer)),
                2e-3)
                << solver << " " << layer;
        EXPECT_EQ(reportOf(folder / "cpu")["options"]["engine"], "cpu");
        EXPECT_NE(reportOf(folder / "gpu")["options"]["engine"], "cpu");
    }
}

// Two tables: a frame of the thesis, and the gather solver after a lamp's power changed.
TEST(GpuProgram, TimesBothSolversStageByStage)
{
    const Outcome run = runRelamp({"bench", kSampleScan, "--engine", "gpu", "--rounds", "1"});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    for (const char* row : {"\nflatten ", "\ndirect ", "\nRSM ", "\nLPV ", "\ndivide ", "\ntotal ",
                            "\ngather ", "\nshading "})
        EXPECT_THAT(run.out, HasSubstr(row));
}

TEST(GpuProgram, SaysWhatIsMissingAndTheWayOut)
{
    const TemporaryFolder folder;
    const Outcome unknown = runRelamp(
        {"delight", kSampleScan, "-o", folder / "out", "--solver", "thesis", "--gpu", "abacus"});
    EXPECT_EQ(unknown.exitCode, 1);
    EXPECT_THAT(unknown.err,
                HasSubstr("no device is called \"abacus\" (relamp devices lists them)"));
    for (const char* command : {"delight", "bench"}) { // before the scan is read
        std::vector<std::string> line{command, folder / "none.glb", "--gpu", "abacus"};
        if (line[0] == "delight") line.insert(line.end(), {"-o", folder / "out"});
        EXPECT_THAT(runRelamp(line).err, HasSubstr("abacus"));
    }
    const Outcome other = runRelamp(
        {"delight", kSampleScan, "-o", folder / "out", "--solver", "pathtrace", "--engine", "gpu"});
    EXPECT_EQ(other.exitCode, 1);
    EXPECT_THAT(other.err, HasSubstr("take another solver"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

} // namespace relamp::golden
