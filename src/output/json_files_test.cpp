// Every JSON file that a person may have written or edited, with every value in it replaced by what
// it must not be.

#include "output/camera_file.h"
#include "output/result_folder.h"
#include "relamp/error.h"
#include "relamp/lights.h"
#include "relamp/relight.h"
#include "relamp/timeline.h"
#include "scenes/temporary_folder.h"

#include <cmath>
#include <functional>
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace relamp
{
namespace
{

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A reader, what it reads, and whether what it made of it may be computed with.
struct JsonFile
{
    const char* name;
    const char* text;
    std::function<bool(const std::filesystem::path&)> isSound;
};

bool isFinite(glm::vec3 v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Lights captured()
{
    Lights lights;
    lights.fixtures.push_back({{1, 2.5f, 1}, {0, -1, 0}, 0.5f, {8, 6, 4}});
    return lights;
}

bool isSound(const Relighting& lighting)
{
    for (const LitFixture& lit : lighting.fixtures)
        if (!isFinite(lit.fixture.radiance) || !isFinite(lit.fixture.centre)) return false;
    for (const NewLight& light : lighting.lights)
        if (!isFinite(light.emission) || !isFinite(light.position) || !isFinite(light.direction))
            return false;
    return isFinite(lighting.sky.radiance);
}

const JsonFile kFiles[] = {
    {"report.json",
     R"({"scan": {"file": "a.glb", "triangles": 12, "up": "y", "scale": 1.0, "transfer": "auto",
                  "longestSide": 0, "skippedMeshes": ["a"]},
         "options": {"quality": "draft", "rays": 64, "lights": [[1, 2, 3]], "notLights": []}})",
     [](const std::filesystem::path& file) {
         const FormerRun run = readFormerRun(file.parent_path());
         const bool arePlaces = std::all_of(run.gather.lights.begin(), run.gather.lights.end(),
                                            [](glm::vec3 place) { return isFinite(place); });
         return arePlaces && run.gather.rays >= 0 && run.gather.rays <= 1024 &&
                run.scan.scale >= 1e-6 && run.scan.scale <= 1e6 && run.scan.longestSide >= 0 &&
                run.triangles <= size_t{1} << 40;
     }},
    {"lights.json",
     R"({"format": "relamp lights 1", "units": "m",
         "fixtures": [{"id": 0, "centre": [1, 2, 3], "normal": [0, -1, 0], "area": 1,
                       "radiance": [1, 1, 1], "power": [1, 1, 1], "on": true, "determined": true}],
         "lights": [{"type": "point", "position": [1, 1, 1], "normal": "omni", "fixture": 0,
                     "share": [1, 1, 1], "radius": 0.1},
                    {"position": [1, 1, 1], "intensity": [1, 1, 1]}],
         "ambient": [0.1, 0.1, 0.1],
         "sun": {"direction": [0, 1, 0], "irradiance": [1, 1, 1]}})",
     [](const std::filesystem::path& file) {
         std::vector<std::string> warnings;
         const Lights lights = readLights(file, warnings);
         return isFinite(lights.ambient) &&
                std::all_of(lights.points.begin(), lights.points.end(), [](const PointLight& p) {
                    return isFinite(p.intensity) && isFinite(p.position);
                });
     }},
    {"lamps.json",
     R"({"white": {"nits": 100, "kelvin": 6504},
         "fixtures": [{"id": 0, "dim": 0.5, "kelvin": 2700, "lumens": 800, "on": true,
                       "window": false, "name": "a"},
                      {"id": 1, "centre": [1, 2, 3], "normal": [0, 1, 0], "area": 1,
                       "radiance": [1, 1, 1]}],
         "lights": [{"type": "spot", "position": [1, 1, 1], "direction": [0, -1, 0], "cone": 60,
                     "blend": 0.1, "radius": 0.1, "lumens": 600, "colour": [1, 1, 1], "name": "b"},
                    {"type": "rectangle", "position": [1, 1, 1], "direction": [0, -1, 0],
                     "along": [1, 0, 0], "size": [1, 1], "nits": 5, "dim": 2},
                    {"type": "sun", "direction": [0, -1, 0], "lux": 1000, "angle": 0.5}],
         "sky": {"nits": 100, "kelvin": 6500, "turn": 90}})",
     [](const std::filesystem::path& file) {
         std::vector<std::string> warnings;
         return isSound(readRelighting(file, captured(), warnings));
     }},
    {"camera.json",
     R"({"format": "relamp camera 1", "position": [1, 2, 3], "target": [0, 0, 0], "up": [0, 1, 0],
         "fieldOfView": 70, "across": "width"})",
     [](const std::filesystem::path& file) {
         std::vector<std::string> warnings;
         const Camera camera = readCamera(file, warnings);
         return isFinite(camera.position) && isFinite(camera.forward) && isFinite(camera.up);
     }},
    {"day.json",
     R"({"format": "relamp timeline 1", "seconds": 8, "keys": [
         {"time": 1, "name": "dawn", "light": {"fixtures": [{"id": 0, "lumens": 9, "dim": 1}]}},
         {"time": 2, "light": {"fixtures": [{"id": 0, "lumens": 90, "on": false}]}}]})",
     [](const std::filesystem::path& file) {
         std::vector<std::string> warnings;
         const Timeline timeline(file, captured(), warnings);
         return isSound(timeline.at(0.0)) && isSound(timeline.at(0.3)) && isSound(timeline.at(1.0));
     }}};

/// Texts of JSON that stand for anything but what belongs there.
const char* const kWrong[] = {"null",
                              "true",
                              "-1",
                              "1.5",
                              "1e300",
                              "-1e300",
                              "1e-300",
                              "1e400",
                              "NaN",
                              "Infinity",
                              "18446744073709551615",
                              "-9223372036854775808",
                              "99999999999999999999999",
                              "\"\"",
                              "\"x\"",
                              "\"\\u001b[31m\"",
                              "\"NaN\"",
                              "[]",
                              "[[]]",
                              "[1e300, 1e300, 1e300]",
                              "[1, 2]",
                              "[\"a\", \"b\", \"c\"]",
                              "[null, null, null]",
                              "{}",
                              "{\"a\": 1}"};

class JsonFiles : public testing::TestWithParam<JsonFile>
{
protected:
    /// Of every value, list and object but the whole.
    [[nodiscard]] std::vector<json::json_pointer> places() const
    {
        std::set<std::string> paths;
        const json values = whole.flatten();
        for (const auto& [path, value] : values.items())
            for (json::json_pointer at(path); !at.empty(); at.pop_back())
                paths.insert(at.to_string());
        return {paths.begin(), paths.end()};
    }

    /// Reads `text`; the test fails where that is neither taken as something sound nor refused with
    /// a sentence.
    void expectTakenOrRefused(const std::string& text) const
    {
        const std::filesystem::path path = folder.write(GetParam().name, text);
        try {
            EXPECT_TRUE(GetParam().isSound(path)) << text;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(),
                        AllOf(StartsWith(folder.path().string()), Not(HasSubstr("[json")),
                              Not(HasSubstr("std::")), Not(HasSubstr("vector")),
                              Not(HasSubstr("basic_string")), Not(HasSubstr("bad_")),
                              Not(HasSubstr("\x1b"))))
                << text;
        } catch (const std::exception& error) {
            ADD_FAILURE() << error.what() << " of " << text;
        }
    }

    scenes::TemporaryFolder folder;
    json whole = json::parse(GetParam().text);
};

} // namespace

TEST_P(JsonFiles, EveryValueIsTakenOrRefusedInASentence)
{
    const std::string kHere = "\"here\"";
    expectTakenOrRefused(whole.dump());
    for (const json::json_pointer& at : places()) {
        json changed = whole;
        changed[at] = "here";
        const std::string text = changed.dump();
        for (const char* wrong : kWrong)
            expectTakenOrRefused(std::string(text).replace(text.find(kHere), kHere.size(), wrong));
    }
}

TEST_P(JsonFiles, EveryKeyMayBeMissing)
{
    for (const json::json_pointer& at : places()) {
        json changed = whole;
        json& around = changed[at.parent_pointer()];
        if (around.is_object())
            around.erase(at.back());
        else
            around.erase(std::stoul(at.back()));
        expectTakenOrRefused(changed.dump());
    }
}

INSTANTIATE_TEST_SUITE_P(, JsonFiles, testing::ValuesIn(kFiles), [](const auto& file) {
    std::string name = file.param.name;
    return name.substr(0, name.find('.'));
});

} // namespace relamp
