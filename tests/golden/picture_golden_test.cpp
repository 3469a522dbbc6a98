// Pictures and films of relamp relight: the real program on the sample room.

#include "golden/program.h"
#include "golden/sample.h"
#include "relamp/image.h"
#include "scenes/temporary_folder.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>

namespace relamp::golden
{
namespace
{

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const std::string kCamera =
    R"({"position": [0.35, 1.65, -0.45], "target": [3.0, 0.8, -2.9], "fieldOfView": 80})";
const std::string kLamp = R"({"lights": [{"type": "sphere", "position": [0.9, 1.45, -2.6],
    "radius": 0.12, "lumens": 1200, "kelvin": 3000}]})";

/// Mean of a picture's green.
double brightness(const std::filesystem::path& file)
{
    const Image image = readImage(file);
    const Radiance radiance(image);
    double sum = 0.0;
    for (size_t i = 0; i < image.pixels(); ++i) sum += radiance[i].g;
    return sum / static_cast<double>(image.pixels());
}

/// The sample without its light, made once.
class PictureProgram : public testing::Test
{
protected:
    static void SetUpTestSuite()
    {
        shared = new scenes::TemporaryFolder;
        shared->write("camera.json", kCamera);
        shared->write("lamp.json", kLamp);
        const Outcome run =
            runRelamp({"delight", kSampleScan, "-o", room(), "--quality", "draft", "-q"});
        ASSERT_EQ(run.exitCode, 0) << run.err;
    }
    static void TearDownTestSuite() { delete shared; }

    static std::string room() { return *shared / "room"; }

    /// What shows light as it is.
    inline static const std::vector<std::string> kPlain{"--view", "standard", "--exposure", "0"};

    /// `relamp relight` of the room with its camera, small; and `more`.
    Outcome relight(const std::vector<std::string>& more) const
    {
        std::vector<std::string> arguments{
            "relight", room(), "-q", "--camera", *shared / "camera.json", "--size", "160x90"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runRelamp(arguments);
    }

    void expectWritten(std::vector<std::string> more,
                       const std::vector<std::string>& view = {}) const
    {
        more.insert(more.end(), view.begin(), view.end());
        const Outcome run = relight(more);
        EXPECT_EQ(run.exitCode, 0) << run.err;
        EXPECT_EQ(run.out, "");
    }

    [[nodiscard]] std::vector<std::string> names(const std::string& in = "") const
    {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder / in))
            names.push_back(entry.path().filename());
        std::sort(names.begin(), names.end());
        return names;
    }

    inline static const scenes::TemporaryFolder* shared = nullptr;
    scenes::TemporaryFolder folder;
    std::string lamp = *shared / "lamp.json";
};

} // namespace

TEST_F(PictureProgram, GoesThroughPipes)
{
    const std::string relit = "$RELAMP relight " + room() + " --camera " +
                              (*shared / "camera.json").string() + " --size 160x90 ";
    const Outcome run =
        runInShell(relit + "--lights - -o - <" + lamp + " >" + (folder / "piped.png").string());
    ASSERT_EQ(run.exitCode, 0) << run.err;
    expectWritten({"--lights", lamp, "-o", folder / "file.png"});
    EXPECT_EQ(contentOf(folder / "piped.png"), contentOf(folder / "file.png"));
    const Outcome empty = runInShell(relit + "--lights - -o - </dev/null");
    EXPECT_EQ(empty.exitCode, 1);
    EXPECT_EQ(empty.out, "");
    EXPECT_THAT(empty.err, HasSubstr("nothing came on standard input"));
    EXPECT_EQ(runInShell(relit + "--lights - -o - <" + lamp + " >/dev/full").exitCode, 1);
    EXPECT_EQ(relight({"--fixture", "all=on", "--bake", "-o", "-"}).exitCode, 2);
}

// A stop more is twice the light, and an EXR is the light itself.
TEST_F(PictureProgram, ALampLightsTheRoom)
{
    expectWritten({"--lights", lamp, "-o", folder / "lit.exr"});
    expectWritten({"--lights", lamp, "-o", folder / "stop.exr", "--exposure", "3"});
    expectWritten({"--lights", lamp, "-o", folder / "lit.png"}, kPlain);
    expectWritten({"--lights", lamp, "-o", folder / "bright.png"},
                  {"--view", "standard", "--exposure", "2"});
    EXPECT_THAT(names(), ElementsAre("bright.png", "lit.exr", "lit.png", "stop.exr"));
    const Image lit = readImage(folder / "lit.exr");
    EXPECT_EQ(lit.width, 160);
    EXPECT_EQ(lit.height, 90);
    EXPECT_EQ(contentOf(folder / "lit.exr"), contentOf(folder / "stop.exr"));
    EXPECT_GT(brightness(folder / "lit.png"), 0.01);
    EXPECT_GT(brightness(folder / "bright.png"), 2.0 * brightness(folder / "lit.png"));
}

// As of a room of a house beside the one that is lit.
TEST_F(PictureProgram, SaysThatNothingIsLitWhereACameraLooks)
{
    folder.write("away.json", R"({"position": [50, 1, 0], "target": [60, 1, 0]})");
    const std::vector<std::string> away{"relight", room(), "--lights",          lamp,      "--size",
                                        "64x36",   "-o",   folder / "away.png", "--camera"};
    const auto relightFrom = [&](const std::filesystem::path& camera) {
        std::vector<std::string> arguments = away;
        arguments.push_back(camera);
        return runRelamp(arguments);
    };
    EXPECT_THAT(relightFrom(folder / "away.json").err, HasSubstr("no light reaches"));
    EXPECT_THAT(relightFrom(*shared / "camera.json").err, Not(HasSubstr("no light reaches")));
}

// Who puts up a lamp wants to see the room in its light, be the lamp strong or weak.
TEST_F(PictureProgram, ANewLightIsExposedByItself)
{
    const std::string weak = folder.write("weak.json", R"({"lights": [{"type": "sphere",
        "position": [0.9, 1.45, -2.6], "radius": 0.12, "lumens": 40, "kelvin": 3000}]})");
    expectWritten({"--lights", lamp, "-o", folder / "lit.png"});
    expectWritten({"--lights", weak, "-o", folder / "weak.png"});
    expectWritten({"--lights", weak, "-o", folder / "plain.png"}, kPlain);
    expectWritten({"--lights", weak, "-o", folder / "more.png", "--exposure", "auto+1"});
    const double lit = brightness(folder / "lit.png");
    EXPECT_THAT(lit, AllOf(testing::Gt(0.12), testing::Lt(0.4)));
    EXPECT_NEAR(brightness(folder / "weak.png"), lit, 0.05 * lit);
    EXPECT_LT(brightness(folder / "plain.png"), 0.2 * lit);
    EXPECT_GT(brightness(folder / "more.png"), 1.3 * lit);
}

TEST_F(PictureProgram, ViewsDifferAndThreadsDoNot)
{
    expectWritten({"--lights", lamp, "-o", folder / "agx.png", "--threads", "1"});
    expectWritten({"--lights", lamp, "-o", folder / "again.png", "--threads", "8"});
    expectWritten({"--lights", lamp, "-o", folder / "named.png", "--view", "agx"});
    expectWritten({"--lights", lamp, "-o", folder / "standard.png", "--view", "standard"});
    expectWritten({"--lights", lamp, "-o", folder / "aces.png", "--view", "aces"});
    EXPECT_EQ(contentOf(folder / "agx.png"), contentOf(folder / "again.png"));
    EXPECT_EQ(contentOf(folder / "agx.png"), contentOf(folder / "named.png"));
    EXPECT_NE(contentOf(folder / "standard.png"), contentOf(folder / "agx.png"));
    EXPECT_NE(contentOf(folder / "aces.png"), contentOf(folder / "agx.png"));
}

// The light of the scan, put back, is about what was scanned; the albedo is something else.
TEST_F(PictureProgram, TheOldLightGivesTheOldPicture)
{
    expectWritten({"--fixture", "all=on", "-o", folder / "back.png"}, kPlain);
    expectWritten({"--show", "scan", "-o", folder / "scan.png"}); // textures are shown as they are
    expectWritten({"--show", "albedo", "-o", folder / "albedo.png"});
    EXPECT_NEAR(brightness(folder / "back.png"), brightness(folder / "scan.png"), 0.05);
    EXPECT_NE(contentOf(folder / "albedo.png"), contentOf(folder / "scan.png"));
}

TEST_F(PictureProgram, TheProgramFindsAViewItself)
{
    const Outcome run = runRelamp(
        {"relight", room(), "--show", "scan", "-o", folder / "auto.png", "--size", "64x36"});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("auto.png in "));
    EXPECT_THAT(run.out, testing::Not(HasSubstr("exposure"))); // the texture is shown as it is
    EXPECT_GT(brightness(folder / "auto.png"), 0.2);           // from inside, for outside is dark
}

TEST_F(PictureProgram, FilmsAreNumberedFrames)
{
    const std::string day = folder.write("day.json", R"({"seconds": 1, "keys": [
        {"time": 0, "light": {"fixtures": [{"id": 0}]}},
        {"time": 1, "light": {"fixtures": [{"id": 0, "dim": 0}]}}]})");
    expectWritten({"--timeline", day, "--fps", "3", "-o", folder / "day"});
    EXPECT_THAT(names("day"),
                ElementsAre("film.json", "frame_0001.png", "frame_0002.png", "frame_0003.png"));
    EXPECT_GT(brightness(folder / "day/frame_0001.png"), brightness(folder / "day/frame_0002.png"));
    EXPECT_LT(brightness(folder / "day/frame_0003.png"), 0.01); // all is off

    expectWritten({"--turntable", "4", "--lights", lamp, "-o", folder / "turn"});
    EXPECT_EQ(names("turn").size(), 5u); // and the list of them
    EXPECT_NE(contentOf(folder / "turn/frame_0001.png"), contentOf(folder / "turn/frame_0003.png"));
}

// Whoever has no ffmpeg is told so before anything takes long.
TEST_F(PictureProgram, AVideoNeedsFfmpeg)
{
    const std::string path = std::getenv("PATH");
    setenv("PATH", folder.path().c_str(), 1);
    const Outcome run = relight({"--turntable", "4", "--lights", lamp, "-o", folder / "turn.mp4"});
    setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_THAT(run.err, HasSubstr("turn.mp4: needs the program ffmpeg"));
    EXPECT_THAT(names(), ElementsAre());
}

TEST_F(PictureProgram, AFolderThatIsNotThereIsToldOfBeforeAllWork)
{
    const Outcome run = relight({"--lights", lamp, "-o", (folder / "none" / "lit.png").string()});
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_THAT(run.err, HasSubstr("none/lit.png: cannot be written: "));
    EXPECT_THAT(run.err, HasSubstr("make that folder"));
}

TEST_F(PictureProgram, AScanWithoutCamerasSaysSo)
{
    const Outcome run = runRelamp({"relight", room(), "--camera", "0", "-o", folder / "a.png"});
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_THAT(run.err, HasSubstr("has no camera 0"));
}

} // namespace relamp::golden
