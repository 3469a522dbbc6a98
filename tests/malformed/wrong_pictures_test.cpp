// Cameras, timelines and IES files that are not as they should be, and what a person types wrong
// about pictures.

#include "malformed/run_in_folder.h"

#include <gmock/gmock.h>

namespace relamp::malformed
{
namespace
{

using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kCamera =
    R"({"format": "relamp camera 1", "position": [0.5, 0.5, 2], "target": [0.5, 0.5, 0]})";
const std::string kLights = R"({"lights": [{"position": [0.5, 0.5, 1], "lumens": 100}]})";
const std::string kTimeline = R"({"format": "relamp timeline 1", "seconds": 0.1, "keys": [
    {"time": 0, "light": {"ambient": [1, 1, 1]}}, {"time": 2, "light": {"ambient": [0, 0, 1]}}]})";
const std::string kIes =
    "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 12\n0 45 90\n0\n100 80 0\n";

class Pictures : public RunInFolder
{
protected:
    void SetUp() override
    {
        write(smallGlb());
        write("camera.json", kCamera);
        write("lights.json", kLights);
        write("day.json", kTimeline);
    }

    [[nodiscard]] golden::Outcome relight(const std::vector<std::string>& more,
                                          const std::string& output = "out.png") const
    {
        std::vector<std::string> arguments{
            "relight", folder / smallGlb().name, "--texture-is-albedo", "-q", "--size", "16x16",
            "-o",      folder / output};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return golden::runRelamp(arguments);
    }

    void expectSentence(const std::vector<std::string>& more, const std::string& words,
                        const std::string& output = "out.png") const
    {
        const std::vector<std::string> before = names();
        const golden::Outcome run = relight(more, output);
        EXPECT_EQ(run.exitCode, 1) << words;
        EXPECT_THAT(run.err, StartsWith("relamp: "));
        EXPECT_THAT(run.err, HasSubstr(words));
        EXPECT_EQ(names(), before);
    }

    void expectUsageError(const std::vector<std::string>& more, const std::string& words,
                          const std::string& output = "out.png") const
    {
        const golden::Outcome run = relight(more, output);
        EXPECT_EQ(run.exitCode, 2) << words;
        EXPECT_THAT(run.err, HasSubstr(words));
    }

    /// However `good` is cut or one of its bits turned over, there is a picture or a sentence.
    void expectNoDamageIsMore(const std::string& name, const std::string& good,
                              const std::vector<std::string>& more,
                              const std::string& output = "out.png") const
    {
        std::vector<std::string> damaged;
        for (const size_t length : scattered(3, good.size()))
            damaged.push_back(good.substr(0, length));
        for (const size_t bit : scattered(5, 8 * good.size()))
            damaged.push_back(flipped(good, bit));
        for (const std::string& bytes : damaged) {
            write(name, bytes);
            const golden::Outcome run = relight(more, output);
            EXPECT_THAT(run.exitCode, AnyOf(0, 1)) << bytes << '\n' << run.err;
            if (run.exitCode == 1) {
                EXPECT_THAT(run.err, StartsWith("relamp: ")) << bytes;
            }
        }
    }

    [[nodiscard]] std::string at(const std::string& name) const { return folder / name; }
};

} // namespace

TEST_F(Pictures, WhatIsGoodIsTaken)
{
    const golden::Outcome run =
        relight({"--camera", at("camera.json"), "--lights", at("lights.json")});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_TRUE(std::filesystem::exists(at("out.png")));
}

TEST_F(Pictures, CamerasThatAreNoneAreRefused)
{
    expectSentence({"--camera", at("nothing.json")}, "nothing.json");
    expectSentence({"--camera", folder.path()}, "directory");
    expectSentence({"--camera", at("lights.json")}, "\"position\" is missing");
    expectSentence({"--camera", "3"}, "has no camera 3");
    expectNoDamageIsMore("camera.json", kCamera,
                         {"--camera", at("camera.json"), "--lights", at("lights.json")});
}

TEST_F(Pictures, TimelinesThatAreNoneAreRefused)
{
    expectSentence({"--timeline", at("lights.json")}, "\"keys\"", "frames");
    expectSentence({"--timeline", at("camera.json")}, "relamp timeline 1", "frames");
    expectNoDamageIsMore("day.json", kTimeline, {"--timeline", at("day.json"), "--fps", "20"},
                         "frames");
}

TEST_F(Pictures, IesFilesThatAreNoneAreRefused)
{
    write("lamp.ies", kIes);
    write("ies.json", R"({"lights": [{"position": [0.5, 0.5, 1], "ies": "lamp.ies"}]})");
    const golden::Outcome run = relight({"--lights", at("ies.json")});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    write("lamp.ies", std::string("no such thing"));
    expectSentence({"--lights", at("ies.json")}, "lamp.ies: is no IES file", "other.png");
    expectNoDamageIsMore("lamp.ies", kIes, {"--lights", at("ies.json")});
}

TEST_F(Pictures, PlacesThatCannotBeWrittenAreSaid)
{
    expectSentence({"--lights", at("lights.json")}, "No such file or directory", "none/out.png");
    std::filesystem::create_directory(at("folder.png"));
    expectSentence({"--lights", at("lights.json")}, "is no file", "folder.png");
    write("taken", kCamera);
    expectSentence({"--timeline", at("day.json")}, "is a file", "taken");
}

TEST_F(Pictures, WhatIsTypedWrongIsNamed)
{
    for (const char* size : {"16", "0x16", "16x", "x", "16x16x16", "99999x1", "-1x5"})
        expectUsageError({"--size", size}, size);
    expectUsageError({"--view", "film"}, "--view");
    for (const char* exposure : {"nan", "33", "auto1", "auto+", "auto+99", "automatic", ""})
        expectUsageError({"--exposure", exposure}, "--exposure");
    expectUsageError({"--bake", "--exposure", "auto"}, "number of stops", "out.glb");
    expectUsageError({"--antialias", "0"}, "--antialias");
    expectUsageError({"--turntable", "0"}, "--turntable");
    expectUsageError({"--fps", "0"}, "--fps");
    expectUsageError({"--show", "all"}, "--show");
    expectUsageError({}, ".png or .exr", "out.gif");
    expectUsageError({"--bake"}, ".exr or .glb");
    for (const char* output : {"out.png", "out.gif", "out.webm"})
        expectUsageError({"--turntable", "4"}, ".mp4", output);
    expectUsageError({"--turntable", "4", "--show", "scan"}, "--show", "out");
    expectUsageError({"--bake", "--turntable", "4"}, "--bake", "out.exr");
}

} // namespace relamp::malformed
