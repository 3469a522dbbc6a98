// relamp relight --bake on what relamp delight writes of the sample room.

#include "golden/program.h"
#include "golden/sample.h"
#include "golden/score.h"
#include "relamp/lights.h"
#include "scenes/temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace relamp::golden
{
namespace
{

using testing::AllOf;
using testing::HasSubstr;

const std::filesystem::path kSample = RELAMP_SAMPLES "/bedroom";

/// dB, peak 1, over the pixels that `counts(i)` chooses; both clamped to 1.
template<class Counts>
double psnr(const Picture& a, const Picture& b, float gain, const Counts& counts)
{
    double error = 0.0;
    double all = 0.0;
    for (size_t i = 0; i < a.rgb.size(); ++i) {
        if (!counts(i)) continue;
        const glm::vec3 off =
            glm::min(gain * a.rgb[i], glm::vec3(1.0f)) - glm::min(gain * b.rgb[i], glm::vec3(1.0f));
        error += static_cast<double>(glm::dot(off, off)) / 3.0;
        all += 1.0;
    }
    return -10.0 * std::log10(error / all);
}

/// The sample without its light, made once.
class RelightProgram : public testing::Test
{
protected:
    static void SetUpTestSuite()
    {
        shared = new scenes::TemporaryFolder;
        const Outcome run = runRelamp({"delight", kSampleScan, "-o", room(), "-q"});
        ASSERT_EQ(run.exitCode, 0) << run.err;
    }
    static void TearDownTestSuite() { delete shared; }

    static std::string room() { return *shared / "room"; }
    static std::filesystem::path out(const std::string& name) { return *shared / name; }

    /// `relamp relight` of the room, baked; and `more`.
    static Outcome bake(const std::filesystem::path& to, const std::vector<std::string>& more)
    {
        std::vector<std::string> arguments{"relight", room(), "-q", "--bake", "-o", to};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runRelamp(arguments);
    }

    static inline scenes::TemporaryFolder* shared = nullptr;
};

} // namespace

// The truth is that of the room as modelled; the sample is its reconstruction, whose error bounds
// what any renderer can reach: path tracing has the same.
TEST_F(RelightProgram, NewLightsAreNearAnIndependentRenderers)
{
    const Picture mask = readPicture(kSample / "mask.png");
    const auto isScored = [&](size_t i) { return mask.rgb[i].r > 0.5f; };
    for (const auto& [name, own, exact] :
         {std::tuple{"relit_A", 28.0, 28.9}, std::tuple{"relit_B", 24.8, 24.8}}) {
        const std::string lights = kSample / (std::string(name) + ".json");
        const float gain = nlohmann::json::parse(contentOf(lights))["display_gain"];
        const Picture truth = readPicture(kSample / (std::string(name) + ".exr"));
        ASSERT_EQ(bake(out("a.exr"), {"--lights", lights}).exitCode, 0);
        EXPECT_NEAR(psnr(readPicture(out("a.exr")), truth, gain, isScored), own, 0.5) << name;
        ASSERT_EQ(bake(out("a.exr"), {"--lights", lights, "--albedo", kSample / "gt_albedo.exr"})
                      .exitCode,
                  0);
        EXPECT_NEAR(psnr(readPicture(out("a.exr")), truth, gain, isScored), exact, 0.5) << name;
    }
}

// But for the drift of the camera's exposure, a third of a stop here, which is no light.
TEST_F(RelightProgram, CapturedLightPutBackShowsTheScan)
{
    const Picture mask = readPicture(kSample / "mask.png");
    const Picture scan = readPicture(kSample / "scan_recon.jpg");
    ASSERT_EQ(bake(out("back.exr"), {"--lights", room() + "/lights.json"}).exitCode, 0);
    const auto isScored = [&](size_t i) {
        const glm::vec3 rgb = scan.rgb[i];
        return mask.rgb[i].r > 0.5f && std::max({rgb.r, rgb.g, rgb.b}) < 0.95f;
    };
    EXPECT_NEAR(psnr(readPicture(out("back.exr")), scan, 1.0f, isScored), 37.3, 0.5);
}

TEST_F(RelightProgram, WritesTheSameBytesOnAnyNumberOfThreadsAndFromAnOldTransport)
{
    const std::vector<std::string> lights{"--lights", kSample / "relit_B.json"};
    ASSERT_EQ(bake(out("1.exr"), lights).exitCode, 0);
    ASSERT_TRUE(std::filesystem::exists(room() + "/transport.bin"));
    auto one = lights;
    one.insert(one.end(), {"--threads", "1"});
    ASSERT_EQ(bake(out("2.exr"), one).exitCode, 0);
    EXPECT_EQ(contentOf(out("1.exr")), contentOf(out("2.exr")));
    one.emplace_back("--no-transport");
    ASSERT_EQ(bake(out("3.exr"), one).exitCode, 0);
    EXPECT_EQ(contentOf(out("1.exr")), contentOf(out("3.exr")));
    std::ofstream(room() + "/transport.bin") << "broken";
    ASSERT_EQ(bake(out("4.exr"), lights).exitCode, 0);
    EXPECT_EQ(contentOf(out("1.exr")), contentOf(out("4.exr")));
    EXPECT_GT(std::filesystem::file_size(room() + "/transport.bin"), 1000000u);
}

TEST_F(RelightProgram, LightmapsOfLampsAddUpToTheirLight)
{
    ASSERT_EQ(bake(out("all.exr"), {"--lights", room() + "/lights.json"}).exitCode, 0);
    ASSERT_EQ(bake(out("maps"), {"--per-lamp", "exr"}).exitCode, 0);
    const Picture all = readPicture(out("all.exr"));
    const Picture albedo = readPicture(out("maps") / "albedo.exr");
    const Picture fixtures = readPicture(out("maps") / "fixtures.png");
    Picture sum = albedo;
    std::fill(sum.rgb.begin(), sum.rgb.end(), glm::vec3(0.0f));
    const auto list = nlohmann::json::parse(contentOf(out("maps") / "lightmaps.json"));
    for (const nlohmann::json& light : list["lights"]) {
        const Picture map = readPicture(out("maps") / light["maps"][0]["file"].get<std::string>());
        for (size_t i = 0; i < sum.rgb.size(); ++i) sum.rgb[i] += map.rgb[i] * albedo.rgb[i];
    }
    EXPECT_EQ(list["lights"].size(), 4u); // a window, two lamps, and what comes in through holes
    const Picture mask = readPicture(kSample / "mask.png");
    const auto isPaint = [&](size_t i) {
        return mask.rgb[i].r > 0.5f && fixtures.rgb[i] == glm::vec3(0.0f);
    };
    // A lamp that is off reflects the light of the others; one that is on does not.
    EXPECT_NEAR(psnr(sum, all, 1.0f, isPaint), 42.3, 0.5);
    EXPECT_THAT(bake(room(), {"--per-lamp", "exr", "--force"}).err,
                HasSubstr("the room's own folder"));
    EXPECT_THAT(bake(out("maps.exr"), {"--per-lamp", "exr"}).err, HasSubstr("a folder"));
    EXPECT_THAT(bake(out("maps.exr"), {"--side", "64"}).err, HasSubstr("--per-lamp"));
}

TEST_F(RelightProgram, BakesAModelThatNeedsNoLight)
{
    const Outcome run = bake(out("baked.glb"), {"--fixture", "all=on", "--exposure", "1"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const Outcome info = runRelamp({"info", out("baked.glb")});
    EXPECT_EQ(info.exitCode, 0) << info.err;
    EXPECT_THAT(contentOf(out("baked.glb")), HasSubstr("KHR_materials_unlit"));
    // And a model whose texture is an albedo can be relit as it is.
    const Outcome again = runRelamp({"relight", room() + "/scan.glb", "-q", "--bake", "-o",
                                     out("glb.exr"), "--lights", kSample / "relit_A.json"});
    EXPECT_EQ(again.exitCode, 0) << again.err;
}

TEST_F(RelightProgram, SaysWhatIsWrongAndLeavesNothing)
{
    const std::string bad = shared->write("bad.json", std::string("{\n\"lights\": [\n{}\n]}"));
    const Outcome run = bake(out("none.exr"), {"--lights", bad});
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_THAT(run.err,
                AllOf(HasSubstr("bad.json"), HasSubstr("\"position\""), HasSubstr("line 3")));
    EXPECT_FALSE(std::filesystem::exists(out("none.exr")));
    EXPECT_THAT(bake(out("none.txt"), {}).err, HasSubstr(".exr"));
    EXPECT_THAT(bake(out("none.exr"), {"--fixture", "99=on"}).err, HasSubstr("no fixture 99"));
    EXPECT_THAT(bake(out("none.exr"), {"--albedo", kSample / "nothing.exr"}).err,
                HasSubstr("nothing.exr"));
    EXPECT_THAT(
        runRelamp({"relight", shared->path() / "nowhere", "--bake", "-o", out("x.exr")}).err,
        HasSubstr("nowhere"));
    EXPECT_EQ(runRelamp({"relight", room()}).exitCode, 2);
}

TEST_F(RelightProgram, SaysThatNothingShines)
{
    const Outcome run = runRelamp({"relight", room(), "--bake", "-o", out("dark.exr")});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("nothing shines"));
}

TEST_F(RelightProgram, StopsWhenAskedTo)
{
    const Outcome run =
        runRelamp({"relight", room(), "-q", "--bake", "-o", out("late.exr"), "--fixture", "all=on",
                   "--solver", "pathtrace", "--samples", "4096"},
                  3.0);
    EXPECT_EQ(run.exitCode, 130);
    EXPECT_FALSE(std::filesystem::exists(out("late.exr")));
    for (const auto& entry : std::filesystem::directory_iterator(shared->path()))
        EXPECT_FALSE(entry.path().filename().string().starts_with(".late")) << entry.path();
}

} // namespace relamp::golden
