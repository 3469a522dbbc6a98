// relamp verify on what relamp delight writes of the sample room.

#include "golden/program.h"
#include "golden/sample.h"
#include "scenes/temporary_folder.h"

#include <fstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace relamp::golden
{
namespace
{

using scenes::TemporaryFolder;
using testing::HasSubstr;

nlohmann::json verified(const std::vector<std::string>& arguments)
{
    std::vector<std::string> all{"verify", "--json"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome run = runRelamp(all);
    EXPECT_EQ(run.exitCode, 0) << run.err;
    return run.exitCode == 0 ? nlohmann::json::parse(run.out) : nlohmann::json();
}

} // namespace

// What a camera did is taken out of the albedo, and of what it is compared with.
TEST(VerifyProgram, TakesOutOfTheScanWhatTheCameraDid)
{
    const TemporaryFolder folder;
    ASSERT_EQ(runRelamp({"delight", kSampleScan, "-o", folder / "out", "-q"}).exitCode, 0);
    nlohmann::json lights = nlohmann::json::parse(std::ifstream(folder / "out" / "lights.json"));
    lights["camera"]["response"] = {0.5, 0.5, 0.5, 0.5, 0.5};
    std::ofstream(folder / "curved.json") << lights;
    ASSERT_EQ(runRelamp({"delight", kSampleScan, "-o", folder / "curved", "-q", "--lights",
                         folder / "curved.json"})
                  .exitCode,
              0);
    const nlohmann::json straight = verified({folder / "out"});
    const nlohmann::json curved = verified({folder / "curved"});
    EXPECT_GT(curved["rmsOfScan"].get<double>(), 1.1 * straight["rmsOfScan"].get<double>());
}

// Albedo times light, every bounce simulated, is the scan again: the gather solver gathered its
// light from the scan, so this says that the light it found is also the light that its own lamps
// and walls make, but for what its correction says of gaps in the mesh.
TEST(VerifyProgram, GatherSolverClosesTheLoopOnTheSample)
{
    const TemporaryFolder folder;
    ASSERT_EQ(runRelamp({"delight", kSampleScan, "-o", folder / "out", "-q"}).exitCode, 0);
    const nlohmann::json found = verified({folder / "out"});
    EXPECT_GT(found["places"], 1500);
    EXPECT_NEAR(found["rmsOfScan"].get<double>(), 0.374, 0.005);
    EXPECT_NEAR(found["rmsError"].get<double>(), 0.0264, 0.003);
    EXPECT_EQ(found["bins"].size(), 5u);
    for (const double ratio : found["ratio"]) EXPECT_NEAR(ratio, 1.0, 0.01);
    std::filesystem::remove(folder / "out/correction.png");
    EXPECT_GT(verified({folder / "out"})["rmsError"].get<double>(), 0.032);
}

TEST(VerifyProgram, SaysWhatIsMissingAndTheWayOut)
{
    const TemporaryFolder folder;
    EXPECT_THAT(runRelamp({"verify", folder / "nothing"}).err,
                HasSubstr("name a folder that relamp delight has written"));

    const std::string scan = folder / "room.glb";
    std::filesystem::copy_file(kSampleScan, scan);
    ASSERT_EQ(
        runRelamp({"delight", scan, "-o", folder / "out", "--solver", "thesis", "-q"}).exitCode, 0);
    std::filesystem::rename(scan, folder / "moved.glb");
    const Outcome moved = runRelamp({"verify", folder / "out"});
    EXPECT_EQ(moved.exitCode, 1);
    EXPECT_THAT(moved.err, HasSubstr("--scan FILE"));
    EXPECT_FALSE(verified({folder / "out", "--scan", folder / "moved.glb"}).is_null());

    std::filesystem::remove(folder / "out/albedo.exr");
    const Outcome gone = runRelamp({"verify", folder / "out", "--scan", folder / "moved.glb"});
    EXPECT_EQ(gone.exitCode, 1);
    EXPECT_THAT(gone.err, HasSubstr("albedo.exr"));
    std::ofstream(folder / "out/report.json") << "{}";
    EXPECT_THAT(runRelamp({"verify", folder / "out"}).err, HasSubstr("report.json"));
}

} // namespace relamp::golden
