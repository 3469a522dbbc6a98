// The real program on the sample room: what it writes, what it says, how well it does.

#include "golden/program.h"
#include "golden/sample.h"
#include "golden/score.h"

#include "relamp/lights.h"
#include "relamp/scan.h"
#include "scenes/temporary_folder.h"

#include <chrono>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace relamp::golden
{
namespace
{

using scenes::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;

std::vector<std::string> namesIn(const std::filesystem::path& folder)
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().filename());
    return names;
}

/// What `relamp delight --quiet` makes of the sample, made once.
class DelightProgram : public testing::Test
{
protected:
    static void SetUpTestSuite()
    {
        shared = new TemporaryFolder;
        said = runRelamp({"delight", kSampleScan, "-o", out(), "--quiet"});
        ASSERT_EQ(said.exitCode, 0) << said.err;
    }
    static void TearDownTestSuite() { delete shared; }

    static std::filesystem::path out() { return *shared / "out"; }

    static inline TemporaryFolder* shared = nullptr;
    static inline Outcome said;
};

} // namespace

// Whose pages lie in files as far as nobody reads them.
TEST_F(DelightProgram, MakesTheSameOfALargeScan)
{
    const TemporaryFolder folder;
    const std::filesystem::path large = folder / "large";
    const Outcome outcome = runInShell("RELAMP_PIXELS_IN_MEMORY=0 $RELAMP delight --quiet " +
                                       kSampleScan + " -o " + large.string());
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    for (const std::string& name : namesIn(out())) {
        if (name == "report.json") continue; // which has the seconds
        EXPECT_TRUE(contentOf(large / name) == contentOf(out() / name)) << name;
    }
}

TEST_F(DelightProgram, WritesAllThatTheGuidePromises)
{
    EXPECT_THAT(namesIn(out()),
                UnorderedElementsAre("albedo.exr", "albedo.png", "confidence.png", "correction.png",
                                     "direct.exr", "fixtures.png", "indirect.exr", "lights.json",
                                     "preview.png", "reasons.png", "report.json", "scan.glb",
                                     "shading.exr"));
    EXPECT_THAT(namesIn(shared->path()),
                testing::ElementsAre("out")); // and nothing half-written beside it

    const auto report = nlohmann::json::parse(contentOf(out() / "report.json"));
    EXPECT_EQ(report["scan"]["triangles"], 39855);
    EXPECT_NEAR(report["closedLoop"]["rmsError"].get<double>(), 0.0138, 0.002);
    EXPECT_EQ(report["lights"]["white"]["nits"], 100.0);
    EXPECT_EQ(report["lights"]["camera"]["contrast"], 1.0); // its camera did nothing
    EXPECT_LT(report["lights"]["camera"]["drifted"], 0.01);
    for (const auto& fixture : report["lights"]["fixtures"]) { // as lamps and windows of homes have
        EXPECT_GT(fixture["lumens"], 300.0);
        EXPECT_LT(fixture["lumens"], 20000.0);
    }
    double share = report["confidence"]["good"];
    for (const auto& low : report["confidence"]["low"]) share += low.get<double>();
    EXPECT_NEAR(share, 1.0, 1e-3);
    EXPECT_NEAR(report["confidence"]["good"].get<double>(), 0.83, 0.02);
    EXPECT_EQ(readPicture(out() / "albedo.png").width, 1024);
}

// The baseline's figures; the input texture itself scores 11.88 dB with a slope of 1.00.
TEST_F(DelightProgram, ThesisSolverTakesSomeShadingOffTheSample)
{
    const TemporaryFolder folder;
    ASSERT_EQ(runRelamp({"delight", kSampleScan, "-o", folder / "out", "--solver", "thesis", "-q"})
                  .exitCode,
              0);
    const Truth truth = truthOfSample(kSampleRoom);
    const Score input = scoreAlbedo(truth.input, truth);
    EXPECT_NEAR(input.psnr, 11.88, 0.05);
    EXPECT_NEAR(input.leakSlope, 1.0, 0.01);
    const Score thesis = scoreAlbedo(readPicture(folder / "out/albedo.exr"), truth);
    EXPECT_NEAR(thesis.psnr, 12.6, 0.3);
    EXPECT_NEAR(thesis.leakSlope, 0.93, 0.02);
}

// Narrow on both sides: who makes it better raises the figures here, who makes it worse sees it.
TEST_F(DelightProgram, GatherSolverTakesTheShadingOffTheSample)
{
    const Score score = scoreAlbedo(readPicture(out() / "albedo.exr"), truthOfSample(kSampleRoom));
    EXPECT_NEAR(score.psnr, 25.6, 0.5);
    EXPECT_NEAR(score.leakSlope, 0.056, 0.02);
}

TEST_F(DelightProgram, WritesTheSameBytesOnOneThreadAndOnEight)
{
    const TemporaryFolder folder;
    ASSERT_EQ(
        runRelamp({"delight", kSampleScan, "-o", folder / "one", "--threads", "1", "-q"}).exitCode,
        0);
    ASSERT_EQ(runRelamp({"delight", kSampleScan, "-o", folder / "eight", "--threads", "8", "-q"})
                  .exitCode,
              0);
    for (const std::string& name : namesIn(folder / "one")) {
        if (name == "report.json") continue; // it tells the seconds
        EXPECT_TRUE(contentOf(folder / ("one/" + name)) == contentOf(folder / ("eight/" + name)))
            << name;
    }
}

TEST_F(DelightProgram, JsonIsAllThatJsonPrints)
{
    const TemporaryFolder folder;
    const Outcome run = runRelamp({"delight", kSampleScan, "-o", folder / "out", "--json"});
    ASSERT_EQ(run.exitCode, 0);
    EXPECT_EQ(run.err, "");
    const auto report = nlohmann::json::parse(run.out);
    EXPECT_EQ(report["options"]["solver"], "gather");
    double seconds = 0.0;
    for (const auto& stage : report["seconds"]["stages"]) seconds += stage.get<double>();
    const double total = report["seconds"]["total"];
    EXPECT_LE(seconds, total + 0.01);
    EXPECT_GE(seconds, 0.95 * total);
}

TEST_F(DelightProgram, QuietIsQuiet)
{
    EXPECT_EQ(said.out + said.err, "");
}

TEST_F(DelightProgram, GlbIsTheScanWithAlbedoAndLights)
{
    Progress progress;
    const Scan before = readScan(kSampleScan, {}, progress);
    const Scan after = readScan(out() / "scan.glb", {}, progress);
    ASSERT_EQ(after.meshes.size(), before.meshes.size());
    EXPECT_EQ(after.meshes[0].positions, before.meshes[0].positions);
    EXPECT_EQ(after.meshes[0].name, before.meshes[0].name);
    EXPECT_EQ(after.pages[0].image.width, before.pages[0].image.width);
    EXPECT_NE(after.pages[0].image.encoded(), before.pages[0].image.encoded());
    EXPECT_THAT(contentOf(out() / "scan.glb"), HasSubstr("KHR_lights_punctual"));
}

TEST_F(DelightProgram, ItsLightsCanBeReadAgain)
{
    const TemporaryFolder folder;
    std::vector<std::string> warnings;
    const Lights lights = readLights(out() / "lights.json", warnings);
    EXPECT_TRUE(warnings.empty());
    EXPECT_EQ(lights.fixtures.size(), 3u);
    const Outcome again = runRelamp(
        {"delight", kSampleScan, "-o", folder / "again", "--lights", out() / "lights.json"});
    EXPECT_EQ(again.exitCode, 0) << again.err;
}

// What it is asked for takes a minute, so it cannot be faster than the finger.
TEST_F(DelightProgram, CtrlCEndsItWithinASecondAndLeavesNothing)
{
    for (const double seconds : {0.05, 0.4, 0.8, 1.6}) {
        const TemporaryFolder folder;
        const auto start = std::chrono::steady_clock::now();
        const Outcome run = runRelamp({"delight", kSampleScan, "-o", folder / "out", "--solver",
                                       "pathtrace", "--samples", "256"},
                                      seconds);
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        EXPECT_EQ(run.exitCode, 130) << run.err;
        EXPECT_LT(elapsed.count(), seconds + 1.0);
        EXPECT_TRUE(namesIn(folder.path()).empty());
    }
}

TEST(InfoProgram, TellsWhatTheSampleIs)
{
    const Outcome run = runRelamp({"info", kSampleScan, "--json"});
    ASSERT_EQ(run.exitCode, 0);
    const auto info = nlohmann::json::parse(run.out);
    EXPECT_EQ(info["triangles"], 39855);
    EXPECT_EQ(info["pages"][0]["width"], 1024);
    EXPECT_NEAR(info["pages"][0]["coverage"].get<double>(), 0.52, 0.01);
    EXPECT_GT(info["pages"][0]["charts"], 500);
    EXPECT_NEAR(info["burntOut"].get<double>(), 0.076, 0.002);
    EXPECT_NEAR(info["camera"]["contrast"].get<double>(), 1.0, 0.05);
    EXPECT_LT(info["camera"]["drifted"], 0.5); // there is none
    EXPECT_EQ(info["camera"]["response"].size(), 5u);
    EXPECT_TRUE(info["openings"].is_array());
    EXPECT_THAT(runRelamp({"info", kSampleScan}).out,
                AllOf(HasSubstr("39855 triangles"), HasSubstr("texture 0 1024 x 1024"),
                      HasSubstr("camera    seems"), HasSubstr("opening")));
}

TEST(Program, HelpHasExamplesAndMistakesExitWithTwo)
{
    EXPECT_THAT(runRelamp({"--help"}).out, HasSubstr("relamp delight kitchen.glb -o kitchen"));
    EXPECT_THAT(runRelamp({"delight", "--help"}).out, HasSubstr("Examples:"));
    EXPECT_EQ(runRelamp({"delight"}).exitCode, 2);
    EXPECT_EQ(runRelamp({"delight", kSampleScan, "-o", "/tmp/x", "--lpv-size", "7"}).exitCode, 2);
    EXPECT_EQ(runRelamp({"paint", kSampleScan}).exitCode, 2);
}

TEST(Program, HelpIsThereHoweverItIsAskedFor)
{
    const std::string help = runRelamp({"--help"}).out;
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{}, {"help"}, {"help", "help"}}) {
        const Outcome run = runRelamp(words);
        EXPECT_EQ(run.exitCode, 0);
        EXPECT_EQ(run.out, help);
    }
    const Outcome run = runRelamp({"help", "delight"});
    EXPECT_EQ(run.exitCode, 0);
    EXPECT_EQ(run.out, runRelamp({"delight", "--help"}).out);
}

// Whoever has not read the guide: words of the house are said in plain ones beside them.
TEST(Program, HelpExplainsItsWords)
{
    EXPECT_THAT(runRelamp({"--help"}).out, HasSubstr("colour of its surfaces (albedo)"));
    const std::string delight = runRelamp({"delight", "--help"}).out;
    EXPECT_THAT(delight, AllOf(HasSubstr("small lamp may be missed"), Not(HasSubstr("surfel"))));
    const std::string relight = runRelamp({"relight", "--help"}).out;
    EXPECT_THAT(relight,
                AllOf(HasSubstr("lamp or window that delight found"), Not(HasSubstr(" page")),
                      HasSubstr("which keeps where bounce light goes")));
}

TEST(Program, SaysWhichCommandIsMeant)
{
    const Outcome scan = runRelamp({kSampleScan});
    EXPECT_EQ(scan.exitCode, 2);
    EXPECT_THAT(scan.err, HasSubstr("relamp delight " + kSampleScan + " -o scan\n"));
    EXPECT_THAT(scan.err, HasSubstr("relamp info " + kSampleScan + "\n"));
    EXPECT_THAT(runRelamp({"it's mine.glb"}).err, HasSubstr("relamp info 'it'\\''s mine.glb'\n"));
    EXPECT_THAT(runRelamp({"delihgt", kSampleScan}).err, HasSubstr("Did you mean relamp delight?"));
    EXPECT_THAT(runRelamp({"photograph"}).err, HasSubstr("There are bench, delight, "));

    const TemporaryFolder folder;
    std::ofstream(folder / "report.json") << "{}";
    const Outcome room = runRelamp({folder.path()});
    EXPECT_EQ(room.exitCode, 2);
    EXPECT_THAT(room.err, HasSubstr("relamp verify " + folder.path().string() + "\n"));
}

TEST(Program, EmptyNamesAreRefused)
{
    const TemporaryFolder folder;
    const std::string out = folder / "out";
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"delight", kSampleScan, "-o", ""},
                                               {"delight", kSampleScan, "-o", out, "--lights", ""},
                                               {"relight", out, "-o", out + ".png", "--camera", ""},
                                               {"relight", out, "-o", out, "--timeline", ""}}) {
        const Outcome run = runRelamp(words);
        EXPECT_EQ(run.exitCode, 2) << testing::PrintToString(words);
        EXPECT_THAT(run.err, HasSubstr("is empty"));
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// A GIF that nobody can write is refused before the room is even looked for.
TEST(Program, FilmsOfUnknownKindsAreRefusedBeforeAnyWork)
{
    const Outcome run = runRelamp({"relight", "no such room", "--turntable", "9", "-o", "day.gif"});
    EXPECT_EQ(run.exitCode, 2);
    EXPECT_THAT(run.err, HasSubstr("a film ends in .mp4 or is a folder"));
}

// An escape character begins a command to the terminal: a new title, another colour, a cleared
// screen.
TEST(Program, NoTerminalObeysTheNamesOfAFile)
{
    const TemporaryFolder folder;
    const std::string scan = folder.write("a\x1b]0;mine\x07.gltf", R"({"asset": {"version": "2.0"},
        "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "\u001b[2J"}],
        "meshes": [{"name": "\u001b[31m\n", "primitives": [{"attributes": {"POSITION": 0}}]}],
        "buffers": [{"byteLength": 36, "uri": "\u001b]0;yours\u0007\u202e.bin"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}], "accessors": [{"bufferView": 0,
        "componentType": 5126, "count": 3, "type": "VEC3"}]})");
    const std::vector<std::vector<std::string>> lines{{"info", scan},
                                                      {"delight", scan, "-o", folder / "out"},
                                                      {"relight", scan, "-o", folder / "out.png"},
                                                      {"verify", scan},
                                                      {"\x1b[2J"},
                                                      {"info", scan, "\x1b[2J"}};
    for (const auto& line : lines) {
        const Outcome run = runRelamp(line);
        EXPECT_NE(run.exitCode, 0);
        EXPECT_THAT(run.err, HasSubstr("\\x1b"));
        for (const std::string& said : {run.out, run.err})
            EXPECT_THAT(said, AllOf(Not(HasSubstr("\x1b")), Not(HasSubstr("\x07")),
                                    Not(HasSubstr("\u202e"))));
    }
}

} // namespace relamp::golden
