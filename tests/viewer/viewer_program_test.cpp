#include "golden/program.h"
#include "scenes/temporary_folder.h"

#include "relamp/devices.h"
#include "relamp/lights.h"
#include "relamp/picture.h"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <future>
#include <iterator>
#include <thread>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace relamp::golden
{
namespace
{

using testing::HasSubstr;
using testing::Not;

const std::filesystem::path kBedroom = std::filesystem::path(RELAMP_SAMPLES) / "bedroom";
const std::filesystem::path kSmallRoom = // a fifth of its texels, for what solves many times
    std::filesystem::path(RELAMP_ROOMS) / "bedroom";
constexpr const char* kCamera = "set camera 0.35 1.65 -0.45 3 0.8 -2.9 80\n";
constexpr const char* kBehindAWall = "set camera 0.5 1.5 -3.8 2.5 1.1 -0.5 80\n";
constexpr const char* kOutside = "set camera 9 4 6 20 8 12 60\n";

std::string textOf(const std::filesystem::path& file)
{
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Vulkan's validation layer looks over every call of the programs that are started while this
/// lives: the loader puts it there, the programs know nothing of it.
class Validation
{
public:
    Validation()
    {
        folder_.write("vk_layer_settings.txt",
                      "khronos_validation.debug_action = VK_DBG_LAYER_ACTION_LOG_MSG\n"
                      "khronos_validation.report_flags = error,warn,perf,info\n"
                      "khronos_validation.enables = "
                      "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT\n"
                      "khronos_validation.log_filename = " +
                          log().string() + "\n");
        setenv("VK_LAYER_SETTINGS_PATH", folder_.path().c_str(), 1);
        setenv("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation", 1);
    }
    ~Validation()
    {
        unsetenv("VK_LAYER_SETTINGS_PATH");
        unsetenv("VK_INSTANCE_LAYERS");
    }
    Validation(const Validation&) = delete;
    Validation& operator=(const Validation&) = delete;

    /// Its complaints are failures, and so is a layer that was not there to complain.
    void expectClean() const
    {
        const std::string said = textOf(log());
        EXPECT_THAT(said, HasSubstr("Khronos Validation Layer Active"))
            << "is vulkan-validationlayers installed?";
        for (const char* complaint : {"(ERROR", "(WARN", "(PERF"})
            EXPECT_THAT(said, Not(HasSubstr(complaint)));
    }

private:
    [[nodiscard]] std::filesystem::path log() const { return folder_ / "log.txt"; }

    scenes::TemporaryFolder folder_;
};

enum class Display { there, missing };

Outcome view(const std::vector<std::string>& arguments, const std::string& script,
             Display display = Display::there)
{
    const scenes::TemporaryFolder home;
    const Validation validation;
    setenv("XDG_CONFIG_HOME", home.path().c_str(), 1);
    std::vector<std::string> all{"view", "--size", "480x270"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    all.insert(all.end(), {"--script", home.write("script.txt", script).string()});
    Outcome outcome = runRelamp(all);
    if (display == Display::there) validation.expectClean();
    return outcome;
}

glm::vec3 meanOf(const Image& image)
{
    const Radiance radiance(image);
    glm::vec3 sum(0.0f);
    for (size_t i = 0; i < image.pixels(); ++i) sum += glm::min(radiance[i], glm::vec3(4.0f));
    return sum / static_cast<float>(image.pixels());
}

/// Share of pixels whose colours are less than `tolerance` apart.
double likeness(const Image& a, const Image& b, float tolerance)
{
    if (a.width != b.width || a.height != b.height) return 0.0;
    const Radiance first(a);
    const Radiance second(b);
    size_t alike = 0;
    for (size_t i = 0; i < a.pixels(); ++i)
        if (glm::length(first[i] - second[i]) < tolerance) ++alike;
    return static_cast<double>(alike) / static_cast<double>(a.pixels());
}

/// The scan as the library's own rays see it from kCamera or, past the room, from kOutside.
Image photograph(const Sky& sky = {})
{
    Progress progress;
    DelitRoom room;
    room.scan = std::make_shared<const Scan>(readScan(kBedroom / "scan.glb", {}, progress));
    std::vector<Image> pages;
    for (const Page& page : room.scan->pages) pages.push_back(page.image);
    room.albedo = pages;
    std::vector<std::string> warnings;
    Camera camera = cameraFor((kBedroom / "camera.json").string(), *room.scan, warnings);
    if (sky.environment)
        camera = {{9.0f, 4.0f, 6.0f},
                  glm::normalize(glm::vec3(11.0f, 4.0f, 6.0f)),
                  {0, 1, 0},
                  glm::radians(60.0f)};
    return Photographer(room, progress)
        .take(pages, camera, {.width = 480, .height = 270, .sky = sky}, progress);
}

/// Another colour in every direction.
Image colouredSky()
{
    Image sky;
    sky.width = 64;
    sky.height = 32;
    for (int y = 0; y < sky.height; ++y)
        for (int x = 0; x < sky.width; ++x)
            for (const int value : {4 * x, 8 * y, 255 - 4 * x})
                sky.encoded().push_back(static_cast<uint8_t>(value));
    return sky;
}

// One run of the program, for a room is solved but once.
TEST(ViewerProgram, ShowsARoomTakesItApartAndLightsItAnew)
{
    const scenes::TemporaryFolder out;
    const auto file = [&](const char* name) { return (out / name).string(); };
    const Sky sky{.radiance = glm::vec3(0.5f, 1.0f, 2.0f),
                  .environment = std::make_shared<const Image>(colouredSky()),
                  .turn = glm::radians(30.0f)};
    Progress progress;
    writeImage(*sky.environment, file("sky.png"), progress);
    const auto light = out.write(
        "sky.json", R"({"sky": {"environment": "sky.png", "radiance": [0.5, 1, 2], "turn": 30}})");
    const Outcome outcome = view(
        {},
        "set quality draft\nset panels off\nopen " + (kBedroom / "scan.glb").string() +
            "\nwait scan\n" + kCamera + "screenshot " + file("scan.exr") +
            " view\nwait solve\npress 6\nscreenshot " + file("albedo.png") + " view\npress 8\n" +
            "wait relit\nscreenshot " + file("again.exr") + " view\npress 1\n" + kBehindAWall +
            "screenshot " + file("behind.exr") + " view\npress 8\nscreenshot " +
            file("behind-relit.exr") + " view\n" + kCamera + "save lights " + file("found.json") +
            "\ndo all-off\ndo add-point\nset lamp.0.position 2 1.6 -2\n" +
            "set lamp.0.lumens 1500\nwait glance\nscreenshot " + file("glance.exr") +
            " view\nwait relit\nscreenshot " + file("bulb.exr") + " view\nsave lights " +
            file("bulb.json") + "\npress ctrl+z\npress ctrl+z\npress ctrl+z\npress ctrl+z\n" +
            "save lights " + file("undone.json") + "\npress ctrl+y\npress ctrl+y\npress ctrl+y\n" +
            "press ctrl+y\nsave lights " + file("redone.json") + "\nset lights " + light.string() +
            "\n" + kOutside + "screenshot " + file("sky.exr") + " view\nquit\n");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;

    const Image scan = readImage(file("scan.exr"));
    // The graphics device and the library's rays see the same room from the same place.
    EXPECT_GT(likeness(scan, photograph(), 0.05f), 0.9);
    // The light of the scan, put back on the albedo, is the scan.
    const glm::vec3 ratio = meanOf(readImage(file("again.exr"))) / meanOf(scan);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(ratio[c], 1.0f, 0.2f);
    // Past the back of a wall, too, though the eye is within the scan's bounds and the sky shines.
    const glm::vec3 behind = meanOf(readImage(file("behind.exr")));
    const glm::vec3 behindRelit = meanOf(readImage(file("behind-relit.exr")));
    for (int c = 0; c < 3; ++c) EXPECT_GT(behindRelit[c] / behind[c], 0.7f);
    // The first look is the light itself, but for fine shadows.
    const glm::vec3 first = meanOf(readImage(file("glance.exr")));
    const glm::vec3 fine = meanOf(readImage(file("bulb.exr")));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(first[c] / fine[c], 1.0f, 0.1f);
    EXPECT_GT(glm::length(fine), 0.01f);
    EXPECT_GT(std::filesystem::file_size(file("albedo.png")), 20000u);
    EXPECT_EQ(textOf(file("undone.json")), textOf(file("found.json")));
    EXPECT_EQ(textOf(file("redone.json")), textOf(file("bulb.json")));
    EXPECT_NE(textOf(file("bulb.json")), textOf(file("found.json")));
    EXPECT_GT(likeness(readImage(file("sky.exr")), photograph(sky), 0.05f), 0.95);
}

// What is said of a lamp on the day of the scan changes the albedo, what is said of it now does
// not.
TEST(ViewerProgram, AlbedoFollowsALampOfTheDayOfTheScan)
{
    const scenes::TemporaryFolder out;
    const auto file = [&](const char* name) { return (out / name).string(); };
    const auto picture = [&](const char* name) {
        return "wait solve\nscreenshot " + file(name) + " view\n";
    };
    const Outcome outcome =
        view({}, "set quality draft\nset panels off\nset marks off\nopen " +
                     (kBedroom / "scan.glb").string() + "\nwait scan\n" + kCamera + "press 6\n" +
                     picture("found.exr") + "set fixture.0.dim 0.5\n" + picture("now.exr") +
                     "press ctrl+z\nset scanned.0.dim 2\n" + picture("brighter.exr") +
                     "set scanned.0.on off\n" + picture("off.exr") + "press ctrl+z\n" +
                     picture("undone.exr") +
                     // One after the other, while the last is followed.
                     "set scanned.0.dim 3\nset scanned.0.kelvin 6500\nset scanned.0.dim 1\n" +
                     "press ctrl+z\npress ctrl+z\npress ctrl+z\npress ctrl+z\n" +
                     picture("again.exr") + "press ctrl+y\n" + picture("redone.exr") +
                     "press 8\nwait relit\nscreenshot " + file("relit.exr") + " view\npress 1\n" +
                     "screenshot " + file("scan.exr") + " view\nquit\n");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;

    const auto read = [&](const char* name) { return readImage(file(name)); };
    const glm::vec3 found = meanOf(read("found.exr"));
    const glm::vec3 brighter = meanOf(read("brighter.exr"));
    for (int c = 0; c < 3; ++c) {
        EXPECT_LT(brighter[c], 0.9f * found[c]);
        EXPECT_GT(meanOf(read("off.exr"))[c], 1.1f * found[c]);
    }
    EXPECT_EQ(likeness(read("now.exr"), read("found.exr"), 1e-6f), 1.0);
    EXPECT_EQ(likeness(read("again.exr"), read("found.exr"), 1e-6f), 1.0);
    EXPECT_EQ(likeness(read("undone.exr"), read("brighter.exr"), 1e-6f), 1.0);
    EXPECT_EQ(likeness(read("redone.exr"), read("brighter.exr"), 1e-6f), 1.0);
    // The darker albedo under the brighter lamp is the scan.
    const glm::vec3 ratio = meanOf(read("relit.exr")) / meanOf(read("scan.exr"));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(ratio[c], 1.0f, 0.2f);
}

/// Whether what a page runs in the browser was made, for which Node.js is needed.
bool hasPages()
{
    return std::filesystem::exists(std::filesystem::path(RELAMP_PROGRAM).parent_path() /
                                   "../web/page/viewer.js");
}

glm::vec3 meanAlbedoIn(const std::filesystem::path& folder)
{
    return meanOf(readImage(folder / "albedo.exr"));
}

// On the GPU engine and a device by its number, which no other test has; after files that could
// not be opened, which leave the room as it was. The script ends before the last result is written,
// and the viewer does not.
TEST(ViewerProgram, SavesWhatWasSaidOfTheDayOfTheScan)
{
    const scenes::TemporaryFolder out;
    const auto file = [&](const char* name) { return (out / name).string(); };
    const std::string page = hasPages() ? "\nsave page " + file("page") + "\nwait rest" : "";
    const Outcome outcome = view(
        {"--engine", "gpu", "--gpu", "0"},
        "set quality draft\nset panels off\nopen " + (kBedroom / "scan.glb").string() +
            "\nwait solve\nsave lights " + file("found.json") + "\nsave result " + file("found") +
            "\nwait rest\ndrop " + file("none.glb") + "\ndrop " +
            out.write("broken.glb", "glTF").string() +
            "\nwait rest\nset scanned.0.dim 2\nset scanned.ambient 1 0.8 0.6\n" +
            "set scanned.ambient 1 0.5 0.25\nwait solve\nwait relit\nsave result " + file("said") +
            "\nsave baked " + file("said.glb") + "\nwait rest" + page + "\nsave lights " +
            file("said.json") + "\npress ctrl+z\npress ctrl+z\npress ctrl+z\nwait solve\n" +
            "save lights " + file("undone.json") + "\nsave result " + file("undone") + "\n");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;

    std::vector<std::string> notes;
    const Lights found = readLights(file("found/lights.json"), notes);
    const Lights said = readLights(file("said/lights.json"), notes);
    EXPECT_EQ(said.fixtures[0].radiance, 2.0f * found.fixtures[0].radiance);
    EXPECT_EQ(said.fixtures[1].radiance, found.fixtures[1].radiance);
    EXPECT_EQ(said.ambient, glm::vec3(1.0f, 0.5f, 0.25f));
    for (int c = 0; c < 3; ++c)
        EXPECT_LT(meanAlbedoIn(file("said"))[c], 0.95f * meanAlbedoIn(file("found"))[c]);
    // As it was said, so it shines: the saved room and its light are the scan again.
    Progress progress;
    const Scan scan = readScan(kBedroom / "scan.glb", {}, progress);
    const Scan baked = readScan(file("said.glb"), {}, progress);
    const glm::vec3 ratio = meanOf(baked.pages[0].image) / meanOf(scan.pages[0].image);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(ratio[c], 1.0f, 0.25f);
    EXPECT_THAT(textOf(file("said.json")), HasSubstr("0.25"));
    EXPECT_EQ(textOf(file("undone.json")), textOf(file("found.json")));
    EXPECT_EQ(textOf(file("undone/lights.json")), textOf(file("found/lights.json")));
    EXPECT_EQ(textOf(file("undone/albedo.exr")), textOf(file("found/albedo.exr")));
    if (page.empty()) return;
    const nlohmann::json room = nlohmann::json::parse(textOf(file("page/room.json")));
    ASSERT_EQ(room["lights"].size(), said.fixtures.size() + 1); // and the sky
    EXPECT_FLOAT_EQ(room["lights"][0]["colour"][0], said.fixtures[0].radiance.r);
    EXPECT_TRUE(std::filesystem::exists(file("page/index.html")));
}

// Parameters, each of which has to reach the solver, and all to come back.
TEST(ViewerProgram, ParametersSolveAgain)
{
    const scenes::TemporaryFolder out;
    const std::vector<std::string> parameters{
        "quality draft",         "parameter.rays 6",         "parameter.darkest 0.7",
        "solver pathtrace",      "parameter.seed 7",         "solver thesis",
        "parameter.power 2",     "parameter.light-levels 1", "parameter.attenuation 1 2 3",
        "parameter.ambient 0.3", "parameter.lpv off",        "parameter.emitter-threshold 0.6"};
    const auto file = [&](size_t i) { return out / (std::to_string(i) + ".exr"); };
    std::string script =
        "set panels off\nset marks off\nset " + parameters[0] + "\nset parameter.samples 1\nopen " +
        (kSmallRoom / "scan.glb").string() +
        "\nwait scan\nset camera 0.3 1.65 0.3 2.4 0.8 2.6 80\npress 5\nwait solve\nscreenshot " +
        file(0).string() + " view\n";
    for (size_t i = 1; i < parameters.size(); ++i) {
        const char* layer = parameters[i] == "parameter.darkest 0.7" ? "6" : "5";
        script += "set " + parameters[i] + "\npress " + layer + "\nwait solve\nscreenshot " +
                  file(i).string() + " view\n";
    }
    for (size_t i = 1; i < parameters.size(); ++i) script += "press ctrl+z\n";
    const std::filesystem::path undone = out / "undone.exr";
    const Outcome outcome =
        view({}, script + "wait solve\nscreenshot " + undone.string() + " view\nquit\n");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;

    EXPECT_EQ(likeness(readImage(undone), readImage(file(0)), 1e-6f), 1.0);
    for (size_t i = 1; i < parameters.size(); ++i) {
        EXPECT_LT(likeness(readImage(file(i)), readImage(file(i - 1)), 1e-4f), 0.999)
            << parameters[i];
    }
}

// Two places of the ceiling, and one of them white: what was said reaches the solver, and comes
// back.
TEST(ViewerProgram, APersonSaysWhatIsOnePaintAndWhatIsWhite)
{
    const scenes::TemporaryFolder out;
    const std::string script =
        "set panels off\nset marks off\nset quality draft\nopen " +
        (kBedroom / "scan.glb").string() + "\nwait solve\n" + kCamera + "press 6\nscreenshot " +
        (out / "found.exr").string() +
        " view\nset place 2.604 2.602 -3.204\npress o\nset place 1.156 2.594 -1.763\npress o\n"
        "wait solve\npress i\nwait solve\nset panels on\nset marks on\nscreenshot " +
        (out / "window.png").string() + "\nset panels off\nset marks off\nscreenshot " +
        (out / "told.exr").string() + " view\nsave result " + (out / "told").string() +
        "\npress ctrl+z\npress ctrl+z\nwait solve\nscreenshot " + (out / "undone.exr").string() +
        " view\n";
    const Outcome outcome = view({}, script);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;

    const auto report = nlohmann::json::parse(textOf(out / "told/report.json"));
    ASSERT_EQ(report["options"]["same"].size(), 1u);
    EXPECT_NEAR(report["options"]["same"][0][0][0].get<double>(), 2.604, 1e-4);
    EXPECT_NEAR(report["options"]["same"][0][1][2].get<double>(), -1.763, 1e-4);
    ASSERT_EQ(report["options"]["white"].size(), 1u);
    const Image found = readImage(out / "found.exr");
    EXPECT_LT(likeness(readImage(out / "told.exr"), found, 1e-3f), 0.5);
    EXPECT_EQ(likeness(readImage(out / "undone.exr"), found, 1e-6f), 1.0);
    const auto lights = nlohmann::json::parse(textOf(out / "told/lights.json"));
    EXPECT_LT(lights["tempering"]["scale"][1].get<double>(), 0.97); // the ceiling had 0.8
}

TEST(ViewerProgram, NamesTheDeviceThatDrawsAsRelampDevicesDoes)
{
    // What draws is named by it where the processor computes, too: that is no way out here.
    for (const char* engine : {"auto", "cpu", "gpu"}) {
        const Outcome wrong =
            view({"--gpu", "abacus", "--engine", engine}, "quit\n", Display::missing);
        EXPECT_EQ(wrong.exitCode, 1);
        EXPECT_THAT(wrong.err,
                    HasSubstr("no device is called \"abacus\" (relamp devices lists them)"));
        EXPECT_THAT(wrong.err, Not(HasSubstr("--engine")));
    }
    const std::string name = gpuDevices().at(0).name;
    EXPECT_EQ(view({"--gpu", name, "--engine", "cpu"}, "quit\n").exitCode, 0);
}

TEST(ViewerProgram, OutlivesWhateverIsDoneToIt)
{
    // Drawn as on a graphics card, which no other test does.
    const Outcome outcome = view({(kBedroom / "scan.glb").string(), "--smooth", "on"},
                                 "set quality draft\nwait scan\nrandom 6 7\nquit\n");

    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
}

TEST(ViewerProgram, SaysWhatIsWrongWithAScript)
{
    const Outcome unknown = view({}, "set panels off\njump\n");
    EXPECT_EQ(unknown.exitCode, 1);
    EXPECT_THAT(unknown.err, HasSubstr("script.txt line 2: \"jump\" is no command"));

    const Outcome missing = view({}, "open /nowhere.glb\nwait solve\n");
    EXPECT_EQ(missing.exitCode, 1);
    EXPECT_THAT(missing.err, HasSubstr("line 2: /nowhere.glb"));

    const Outcome unnoticed = view({}, "open /nowhere.glb\nwait 3\n");
    EXPECT_EQ(unnoticed.exitCode, 1);
    EXPECT_THAT(unnoticed.err, HasSubstr("line 2: /nowhere.glb"));
}

// A drag of a quarter turn and more, either way: what is in front of the eye is the room, seen from
// inside. From behind a wall half of the view is what is culled there: nothing.
TEST(ViewerProgram, OrbitStaysInTheRoom)
{
    const scenes::TemporaryFolder out;
    const auto file = [&](int i) { return (out / std::to_string(i)).string() + ".exr"; };
    std::string script = "set quality draft\nset panels off\nset marks off\nwait draft\n";
    for (int i = 0; i < 4; ++i) script += "drag 60 135 420 135\nscreenshot " + file(i) + " view\n";
    const Outcome outcome = view({(kBedroom / "scan.glb").string()}, script);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;

    for (int i = 0; i < 4; ++i) {
        const Image image = readImage(file(i));
        const Radiance seen(image);
        size_t nothing = 0;
        for (size_t p = 0; p < 480 * 270; ++p) nothing += seen[p] == glm::vec3(0.0f) ? 1u : 0u;
        EXPECT_LT(nothing, 480u * 270u / 50u) << i;
    }
}

// Neither a script nor a person can do with a file that is not there.
TEST(ViewerProgram, EndsWhereTheFileOfTheCommandLineCannotBeRead)
{
    const scenes::TemporaryFolder home;
    const Outcome driven = view({"/nowhere.glb"}, "wait 30\n");
    setenv("XDG_CONFIG_HOME", home.path().c_str(), 1);
    const Outcome byHand = runRelamp({"view", "/nowhere.glb"}); // settings are kept then

    for (const Outcome& outcome : {driven, byHand}) {
        EXPECT_EQ(outcome.exitCode, 1);
        EXPECT_THAT(outcome.err, HasSubstr("relamp: /nowhere.glb"));
        EXPECT_THAT(outcome.err, Not(HasSubstr("script.txt")));
    }
}

/// The lights of one's own in a file that may not be there yet.
nlohmann::json lampsIn(const std::filesystem::path& file)
{
    const auto light = nlohmann::json::parse(textOf(file), nullptr, false);
    return light.is_object() ? light["lights"] : nlohmann::json();
}

/// Whether something comes true in a minute, tried again and again.
bool comes(const std::function<bool()>& isThere)
{
    for (int i = 0; i < 300; ++i) {
        if (isThere()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    return false;
}

// By the window system's own events, press and release between two frames. The light is saved into
// the working folder.
TEST(ViewerProgram, AClickOnPointPutsUpALamp)
{
    const scenes::TemporaryFolder out;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(out.path());
    const std::filesystem::path saved = out / "scan_lights.json";
    auto running = std::async(std::launch::async, [&] {
        return view({(kBedroom / "scan.glb").string()},
                    "set quality draft\nsize 1280 800\nwait scan\nstay\n");
    });
    const auto isHeard = [&] { // for until the script has ended nobody is
        EXPECT_EQ(std::system("xdotool key ctrl+s"), 0) << "is xdotool installed?";
        return std::filesystem::exists(saved);
    };
    EXPECT_TRUE(comes(isHeard));
    const char* const click = "xdotool search --onlyvisible --name '^relamp' "
                              "mousemove --window %1 35 432 click 1 key ctrl+s";
    EXPECT_EQ(std::system(click), 0);
    EXPECT_TRUE(comes([&] { return !lampsIn(saved).empty(); }));
    EXPECT_EQ(std::system("xdotool key ctrl+q"), 0);
    const Outcome outcome = running.get();
    std::filesystem::current_path(before);

    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    const nlohmann::json lamps = lampsIn(saved);
    ASSERT_EQ(lamps.size(), 1u);
    EXPECT_EQ(lamps[0]["type"], "point");
}

TEST(ViewerProgram, SaysThatThereIsNoDisplay)
{
    const char* display = std::getenv("DISPLAY");
    const std::string before = display == nullptr ? "" : display;
    unsetenv("DISPLAY");
    const Outcome outcome = view({}, "quit\n", Display::missing);
    setenv("DISPLAY", before.c_str(), 1);

    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_THAT(outcome.err, HasSubstr("there is no display"));
}

} // namespace
} // namespace relamp::golden
