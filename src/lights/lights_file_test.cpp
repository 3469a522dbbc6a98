#include "relamp/lights.h"

#include "base/radiometry.shared.h"
#include "scenes/refusal.h"
#include "scenes/temporary_folder.h"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using testing::AllOf;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pointwise;
using testing::SizeIs;

std::vector<std::string> lastWarnings;

Lights read(const std::string& text)
{
    const scenes::TemporaryFolder folder;
    lastWarnings.clear();
    return readLights(folder.write("lights.json", text), lastWarnings);
}

std::string refusal(const std::string& text)
{
    return scenes::refusalOf([&] { read(text); });
}

const std::string kLamp = R"({"centre": [1, 2, 3], "area": 2, "radiance": [4, 2, 0])";
const std::string kPoint = R"({"position": [1, 2, 3], "intensity": [4, 2, 1])";

std::string shareOf(int fixture, float share)
{
    return fmt::format(R"({{"position": [1, 2, 3], "fixture": {}, "share": [{}, {}, {}]}})",
                       fixture, share, share, share);
}

} // namespace

TEST(LightsFile, NumbersAndNamesComeBack)
{
    Lights lights;
    lights.fixtures = {{.area = 1.0f, .radiance = glm::vec3(1.0f), .id = 7, .name = "window 7"},
                       {.area = 1.0f, .radiance = glm::vec3(2.0f), .id = 2, .unseen = 0.25f}};
    lights.fixtures[1].group = 7;
    lights.points = {{.intensity = glm::vec3(0.5f), .fixture = 1}};
    EXPECT_THAT(lightsAsJson(lights), testing::HasSubstr("\"fixture\": 2"));
    const Lights again = read(lightsAsJson(lights));
    EXPECT_EQ(again.idOf(0), 7);
    EXPECT_EQ(again.nameOf(0), "window 7");
    EXPECT_EQ(again.nameOf(1), "fixture 2");
    EXPECT_EQ(again.fixtures[1].unseen, 0.25f);
    EXPECT_EQ(again.fixtures[1].group, 7);
    EXPECT_EQ(again.fixtures[0].group, -1);
    EXPECT_EQ(again.placeOf(2), 1u);
    EXPECT_EQ(again.placeOf(1), 2u); // nobody's
    EXPECT_EQ(again.points[0].fixture, 1);
    EXPECT_EQ(again.points[0].intensity, glm::vec3(0.5f));
    EXPECT_THAT(lastWarnings, IsEmpty());
}

TEST(LightsFile, FixturesWithoutNumbersAreCounted)
{
    const Lights lights = read("{\"fixtures\": [" + kLamp + "}, " + kLamp + "}]}");
    EXPECT_EQ(lights.idOf(0), 0);
    EXPECT_EQ(lights.idOf(1), 1);
    EXPECT_EQ(lights.placeOf(1), 1u);
    EXPECT_EQ(lights.fixtures[0].id, -1); // nobody takes it for a lamp of the scan
    EXPECT_THAT(lastWarnings, IsEmpty());
}

// A person copies an entry to add a lamp.
TEST(LightsFile, ACopiedFixtureGetsANumberOfItsOwn)
{
    const std::string lamp = kLamp + ", \"id\": 5}";
    const Lights lights = read("{\"fixtures\": [" + lamp + "," + lamp + "," + kLamp + "}]}");
    EXPECT_EQ(lights.idOf(0), 5);
    EXPECT_EQ(lights.idOf(1), 6);
    EXPECT_EQ(lights.idOf(2), 7);
    for (size_t place = 0; place < 3; ++place) EXPECT_EQ(lights.placeOf(lights.idOf(place)), place);
    EXPECT_THAT(lastWarnings, SizeIs(1));
    EXPECT_THAT(refusal("{\"fixtures\": [" + kLamp + ", \"id\": \"five\"}]}"),
                testing::HasSubstr("number of a fixture"));
}

TEST(LightsFile, SunComesBack)
{
    Lights lights;
    lights.sun = Sun{.direction = {0.6f, 0.8f, 0.0f}, .irradiance = {30.0f, 28.0f, 20.0f}};
    const Lights again = read(lightsAsJson(lights));
    ASSERT_TRUE(again.sun);
    EXPECT_EQ(again.sun->direction, lights.sun->direction);
    EXPECT_EQ(again.sun->irradiance, lights.sun->irradiance);
    EXPECT_THAT(lastWarnings, IsEmpty());
    EXPECT_FALSE(read(R"({"ambient": [1, 1, 1]})").sun);
}

TEST(LightsFile, SunWithoutASenseIsRefused)
{
    EXPECT_THAT(refusal(R"({"sun": [1, 2, 3]})"), HasSubstr("\"sun\" must be an object"));
    EXPECT_THAT(refusal(R"({"ambient": [1, 1, 1], "camera": {"response": [1, 1]}})"),
                HasSubstr("must be 5 slopes"));
    EXPECT_THAT(refusal(R"({"ambient": [1, 1, 1], "camera": {"response": [1, 1, 1, 1, -1]}})"),
                HasSubstr("-1"));
    EXPECT_THAT(refusal(R"({"ambient": [1, 1, 1], "camera": {"gain": {"origin": [0, 0, 0],
                            "spacing": 1, "count": [2, 1, 1], "stops": [0]}}})"),
                HasSubstr("2 knots"));
    EXPECT_THAT(
        refusal(R"({"ambient": [1, 1, 1], "tempering": {"power": 0.5, "kept": [1, 0, 1]}})"),
        HasSubstr("\"kept\" must be above 0"));
    EXPECT_THAT(
        refusal(
            R"({"ambient": [1, 1, 1], "tempering": {"power": 1, "kept": [1, 1, 1], "scale": [1, 1e-9, 1]}})"),
        HasSubstr("\"scale\" must be"));
    EXPECT_THAT(
        refusal(R"({"ambient": [1, 1, 1], "tempering": {"power": 1.5, "kept": [1, 1, 1]}})"),
        HasSubstr("\"power\""));
    EXPECT_THAT(refusal(R"({"sun": {"irradiance": [1, 1, 1]}})"),
                HasSubstr("sun: \"direction\" is missing"));
    EXPECT_THAT(refusal(R"({"sun": {"direction": [0, 0, 0], "irradiance": [1, 1, 1]}})"),
                HasSubstr("must point somewhere"));
    EXPECT_THAT(refusal(R"({"sun": {"direction": [0, 1, 0], "irradiance": [1, -1, 1]}})"),
                HasSubstr("must not be negative"));
}

TEST(LightsFile, SaysOfWhichFixtureTheScanDoesNotTell)
{
    Lights lights{.fixtures = {{.area = 1.0f, .radiance = glm::vec3(20.0f)},
                               {.area = 1.0f, .radiance = glm::vec3(1.0f), .determined = false}}};
    const std::string text = lightsAsJson(lights);
    EXPECT_EQ(text.find("\"determined\": false"), text.rfind("\"determined\""));
    EXPECT_NE(text.find("\"determined\""), std::string::npos);
    EXPECT_TRUE(read(text).fixtures[1].determined); // what a person passes is no guess
    EXPECT_THAT(lastWarnings, IsEmpty());
}

TEST(LightsFile, WhatWasWrittenIsReadAgain)
{
    Lights lights;
    lights.fixtures.push_back({{0.1f, 2.5f, -1.0f}, {0, -1, 0}, 0.25f, {8, 7.5f, 6}});
    lights.points.push_back({{0.1f, 2.4f, -1.0f}, {0, -1, 0}, {0.5f, 0.25f, 0.125f}, 0.3f, 0});
    lights.points.push_back({{3, 2, 1}, {0, 0, 0}, {1, 1, 1}, 0.0f, -1});
    lights.ambient = {0.1f, 0.2f, 0.3f};
    lights.openings = {{0.1f, 0.1f, 0.2f}, {5.0f, 6.0f, 7.0f}};
    lights.camera.response.slope = {0.7f, 0.8f, 0.9f, 1.0f, 1.25f};
    lights.camera.gains = {{{-1, 0, 2.5f}, 1.25f, {3, 2, 1}, {}}};
    for (const float log : {0.1f, 0.0f, -0.2f, 0.3f, 0.0f, 0.0f})
        lights.camera.gains[0].log.emplace_back(log, log, 2.0f * log);
    lights.camera.drifted = 0.25f;
    lights.camera.tone = {0.625f, {{0, 1, 0}, 0.5f, {1, 1, 2}, {glm::vec3(0.5f), glm::vec3(-1)}}};
    lights.tempering = {.kept = {0.5f, 0.4f, 0.3f}, .power = 0.8f, .scale = {0.75f, 0.8f, 0.9f}};
    lights.gaps = 0.6f;
    const Lights again = read(lightsAsJson(lights));
    ASSERT_THAT(again.fixtures, SizeIs(1));
    EXPECT_EQ(again.fixtures[0].centre, lights.fixtures[0].centre);
    EXPECT_EQ(again.fixtures[0].radiance, lights.fixtures[0].radiance);
    ASSERT_THAT(again.points, SizeIs(2));
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(again.points[i].position, lights.points[i].position);
        EXPECT_EQ(again.points[i].normal, lights.points[i].normal);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(again.points[i].intensity[c], lights.points[i].intensity[c], 1e-7f);
        EXPECT_EQ(again.points[i].radius, lights.points[i].radius);
        EXPECT_EQ(again.points[i].fixture, lights.points[i].fixture);
    }
    EXPECT_EQ(again.ambient, lights.ambient);
    EXPECT_EQ(again.openings, lights.openings);
    EXPECT_EQ(again.camera.response, lights.camera.response);
    ASSERT_THAT(again.camera.gains, SizeIs(1));
    const Gain& gain = again.camera.gains[0];
    EXPECT_EQ(gain.origin, lights.camera.gains[0].origin);
    EXPECT_EQ(gain.count, lights.camera.gains[0].count);
    ASSERT_EQ(gain.log.size(), lights.camera.gains[0].log.size());
    for (size_t k = 0; k < gain.log.size(); ++k)
        EXPECT_LT(glm::distance(gain.log[k], lights.camera.gains[0].log[k]), 1e-6f);
    EXPECT_EQ(again.camera.drifted, 0.25f);
    EXPECT_EQ(again.camera.tone.exponent, 0.625f);
    ASSERT_EQ(again.camera.tone.gain.log.size(), 2u);
    EXPECT_LT(glm::distance(again.camera.tone.gain.log[1], glm::vec3(-1.0f)), 1e-6f);
    EXPECT_EQ(again.tempering, lights.tempering);
    EXPECT_EQ(again.gaps, lights.gaps);
    EXPECT_THAT(lastWarnings, IsEmpty());
}

TEST(LightsFile, EveryRoomHasAGain)
{
    Lights lights;
    lights.ambient = glm::vec3(1.0f);
    lights.camera.drifted = 0.75f;
    lights.camera.gains = {{{0, 0, 0}, 1.0f, {2, 1, 1}, {glm::vec3(0.25f), glm::vec3(-0.25f)}},
                           {{9, 0, 1}, 0.5f, {1, 1, 1}, {glm::vec3(0.0f)}}};
    const Lights again = read(lightsAsJson(lights));
    EXPECT_THAT(lastWarnings, IsEmpty());
    ASSERT_THAT(again.camera.gains, SizeIs(2));
    EXPECT_EQ(again.camera.drifted, 0.75f);
    EXPECT_NEAR(again.camera.gains[0].log[1].g, -0.25f, 1e-6f);
    EXPECT_EQ(again.camera.gains[1].origin, glm::vec3(9, 0, 1));
    EXPECT_EQ(again.camera.gains[1].log, std::vector<glm::vec3>{glm::vec3(0.0f)});
    read(R"({"ambient": [1, 1, 1], "camera": {"gain": {"rooms": [], "spacing": 1}}})");
    EXPECT_THAT(lastWarnings, ElementsAre(HasSubstr("\"spacing\"")));
    EXPECT_THAT(refusal(R"({"ambient": [1, 1, 1], "camera": {"gain": {"rooms": 3}}})"),
                HasSubstr("\"rooms\" must be a list"));
    EXPECT_THAT(
        refusal(R"({"ambient": [1, 1, 1], "camera": {"gain": {"rooms": [{"origin": [0, 0, 0],
                            "spacing": 1, "count": [2, 1, 1], "stops": [0]}]}}})"),
        HasSubstr("room 0: \"stops\" has 1 numbers"));
}

// A patch of area A and radiance L sends pi L A; a point spreads that over 4 pi.
TEST(LightsFile, AFixtureAloneShinesFromItsCentre)
{
    const Lights lights = read(R"({"fixtures": [)" + kLamp + "}]}");
    ASSERT_THAT(lights.points, SizeIs(1));
    EXPECT_EQ(lights.points[0].position, glm::vec3(1, 2, 3));
    EXPECT_EQ(lights.points[0].intensity, glm::vec3(2, 1, 0));
    EXPECT_NEAR(lights.points[0].radius, std::sqrt(2.0f / kPi), 1e-6f);
}

TEST(LightsFile, AFixtureThatIsOffTakesItsLightsAlong)
{
    const std::string off = R"({"fixtures": [)" + kLamp + R"(, "on": false}, )" + kLamp + "}]";
    EXPECT_THAT(read(off + "}").points, SizeIs(1));
    const Lights lights =
        read(off + R"(, "lights": [)" + shareOf(0, 1.0f) + ", " + shareOf(1, 1.0f) + "]}");
    ASSERT_THAT(lights.points, SizeIs(1));
    EXPECT_EQ(lights.points[0].fixture, 1);
}

// Half of the flux of a fixture of twice the radiance is all of what it was.
TEST(LightsFile, LightsFollowTheRadianceOfTheirFixture)
{
    const std::string rest = R"(], "lights": [)" + shareOf(0, 0.5f) + "]}";
    const std::string bright = R"({"centre": [1, 2, 3], "area": 2, "radiance": [8, 4, 0]})";
    EXPECT_EQ(read(R"({"fixtures": [)" + kLamp + "}" + rest).points[0].intensity,
              glm::vec3(1.0f, 0.5f, 0.0f));
    EXPECT_EQ(read(R"({"fixtures": [)" + bright + rest).points[0].intensity,
              glm::vec3(2.0f, 1.0f, 0.0f));
}

TEST(LightsFile, AFixtureThatIsAddedShinesBesideTheOthers)
{
    const Lights lights = read(R"({"fixtures": [)" + kLamp + "}, " + kLamp + R"(}], "lights": [)" +
                               shareOf(0, 0.5f) + ", " + shareOf(0, 0.5f) + "]}");
    ASSERT_THAT(lights.points, SizeIs(3));
    EXPECT_EQ(lights.points[2].fixture, 1);
    EXPECT_EQ(lights.points[2].intensity, glm::vec3(2, 1, 0));
}

// A share of nothing would lose it.
TEST(LightsFile, ALightThatItsFixtureDoesNotExplainIsWrittenByItself)
{
    Lights lights;
    lights.fixtures.push_back({{0, 2, 0}, {0, -1, 0}, 0.25f, {8, 0, 0}});
    lights.points.push_back({{0, 2, 0}, {0, -1, 0}, {1, 1, 0}, 0.0f, 0});
    EXPECT_EQ(read(lightsAsJson(lights)).points[0].intensity, glm::vec3(1, 1, 0));
}

TEST(LightsFile, DarkLightsAreNone)
{
    EXPECT_THAT(
        read(
            R"({"lights": [{"position": [0, 0, 0], "intensity": [0, 0, 0]}], "ambient": [1, 1, 1]})")
            .points,
        IsEmpty());
    EXPECT_THAT(refusal(R"({"lights": [{"position": [0, 0, 0], "intensity": [0, 0, 1e-30]}]})"),
                HasSubstr("holds no light"));
    EXPECT_THAT(refusal("{}"), HasSubstr("holds no light"));
}

TEST(LightsFile, NormalsAreMadeUnitAndOmniIsNone)
{
    const Lights lights = read(R"({"lights": [)" + kPoint + R"(, "normal": [0, 0, -5]}, )" +
                               kPoint + R"(, "normal": "omni"}]})");
    EXPECT_EQ(lights.points[0].normal, glm::vec3(0, 0, -1));
    EXPECT_EQ(lights.points[1].normal, glm::vec3(0.0f));
}

TEST(LightsFile, AFixtureThatIsNotThereIsNamed)
{
    for (const char* index : {"1", "7", "-3", "0.5", "1e+20", "\"a\"", "null"})
        EXPECT_THAT(refusal(R"({"fixtures": [)" + kLamp +
                            R"(}], "lights": [{"position": [1, 2, 3], )"
                            R"("share": [1, 1, 1], "fixture": )" +
                            index + "}]}"),
                    HasSubstr("lights.json: light 0: \"fixture\" is " + std::string(index)))
            << index;
    EXPECT_THAT(refusal(R"({"fixtures": [)" + kLamp + R"(}], "lights": [)" + kPoint +
                        R"(, "fixture": 0}]})"),
                HasSubstr("light 0: \"intensity\" is for lights without \"fixture\""));
    EXPECT_THAT(refusal(R"({"lights": [)" + kPoint + R"(, "share": [1, 1, 1]}]})"),
                HasSubstr("light 0: \"share\" is that of a fixture"));
}

// What is no list, no object, no text or no truth value is refused wherever it stands.
TEST(LightsFile, ValuesOfAnotherKindAreRefusedByFileAndKey)
{
    const auto inTop = [](const std::string& key, const std::string& value) {
        return refusal("{\"" + key + "\": " + value + "}");
    };
    for (const char* key : {"fixtures", "lights"})
        for (const char* value : {"{}", "null", "7", "\"none\"", "true"})
            EXPECT_THAT(inTop(key, value), AllOf(HasSubstr("lights.json: "), HasSubstr(key)))
                << key << value;
    for (const char* value : {"{}", "null", "7", "[]", "true"}) {
        EXPECT_THAT(inTop("format", value), HasSubstr("lights.json: its format is")) << value;
        EXPECT_THAT(inTop("ambient", value), HasSubstr("\"ambient\"")) << value;
        EXPECT_THAT(refusal(R"({"fixtures": [)" + kLamp + R"(, "normal": )" + value + "}]}"),
                    HasSubstr("lights.json: fixture 0: \"normal\""))
            << value;
        EXPECT_THAT(refusal(R"({"lights": [)" + kPoint + R"(, "type": )" + value + "}]}"),
                    HasSubstr("lights.json: light 0: \"type\" is"))
            << value;
    }
}

TEST(LightsFile, UnknownKeysAreSaid)
{
    read(R"({"lights": [)" + kPoint + R"(, "colour": 3}], "author": "me"})");
    EXPECT_THAT(lastWarnings, ElementsAre(HasSubstr("\"author\" is not known"),
                                          HasSubstr("light 0: \"colour\"")));
}

TEST(LightsFile, MistakesAreNamedWithTheirPlace)
{
    const auto light = [](const std::string& members) {
        return R"({"lights": [)" + kPoint + "}, {" + members + "}]}";
    };
    EXPECT_THAT(refusal(light(R"("intensity": [1, 1, 1])")),
                HasSubstr("lights.json: light 1: \"position\" is missing"));
    EXPECT_THAT(refusal(light(R"("position": [1, 1], "intensity": [1, 1, 1])")),
                HasSubstr("must be a list of three numbers"));
    EXPECT_THAT(refusal(light(R"("position": [1, 1, "up"], "intensity": [1, 1, 1])")),
                HasSubstr("must be a number"));
    EXPECT_THAT(refusal(light(R"("position": [1, 1, 1e300], "intensity": [1, 1, 1])")),
                HasSubstr("between -1e9 and 1e9"));
    EXPECT_THAT(refusal(light(R"("position": [1, 1, 1], "intensity": [1, -1, 1])")),
                HasSubstr("must not be negative"));
    EXPECT_THAT(refusal(light(R"("position": [1, 1, 1], "intensity": [1, 1, 1], "type": "spot")")),
                HasSubstr("\"type\" is \"spot\""));
    EXPECT_THAT(refusal(light(R"("position": [1, 1, 1], "intensity": [1, 1, 1], "radius": -1)")),
                HasSubstr("must not be negative"));
    EXPECT_THAT(refusal(R"({"lights": [7]})"), HasSubstr("light 0: must be an object"));
    EXPECT_THAT(refusal(R"({"lights": 7})"), HasSubstr("\"lights\" must be a list"));
    EXPECT_THAT(refusal(R"({"fixtures": {}})"), HasSubstr("\"fixtures\" must be a list"));
    EXPECT_THAT(refusal(R"({"fixtures": [)" + kLamp + R"(, "on": "no"}]})"),
                HasSubstr("\"on\" must be true or false"));
    EXPECT_THAT(refusal(R"({"format": "relamp lights 9"})"),
                HasSubstr("its format is \"relamp lights 9\""));
}

TEST(LightsFile, WhatIsNoJsonIsNamedWithItsLine)
{
    EXPECT_THAT(refusal("{\n\"lights\": [,]}"),
                HasSubstr("lights.json: its JSON cannot be read: parse error at line 2"));
    EXPECT_THAT(refusal("[]"), HasSubstr("is not an object"));
    EXPECT_THAT(refusal(std::string(300, '[')), HasSubstr("nested deeper"));
    EXPECT_THAT(refusal("\xff\xfe"), HasSubstr("its JSON cannot be read"));
    EXPECT_THAT(refusal("{\"format\": \"\xff\"}"), HasSubstr("lights.json"));
    EXPECT_THAT(refusal(""), HasSubstr("is empty (0 bytes)"));
}

} // namespace relamp
