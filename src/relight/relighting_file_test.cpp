#include "base/radiometry.shared.h"
#include "relamp/relight.h"
#include "relight/photometry.h"
#include "scenes/refusal.h"
#include "scenes/temporary_folder.h"

#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<std::string> lastWarnings;

Lights twoFixtures()
{
    Lights captured;
    captured.fixtures.push_back({{1, 2.5f, 1}, {0, -1, 0}, 0.5f, {8, 6, 4}});
    captured.fixtures.push_back({{3, 2.5f, 1}, {0, 0, 0}, 0.1f, {20, 20, 20}});
    return captured;
}

Relighting read(const std::string& text)
{
    const scenes::TemporaryFolder folder;
    lastWarnings.clear();
    return readRelighting(folder.write("lamps.json", text), twoFixtures(), lastWarnings);
}

std::string refusalOfLights(const std::string& text)
{
    return scenes::refusalOf([&] { read(text); });
}

std::string refusalOfLight(const std::string& light)
{
    return refusalOfLights("{\n\"lights\": [\n{" + light + "}\n]}");
}

std::string refusalOfSetting(const std::string& setting)
{
    Relighting lighting = darkened(twoFixtures());
    return scenes::refusalOf([&] { setFixture(lighting, twoFixtures(), setting); });
}

} // namespace

TEST(RelightingFile, ReadsLightsOfAllTypes)
{
    const Relighting lighting = read(R"({"lights": [
        {"position": [1, 2, 3], "intensity": [3, 2, 1]},
        {"type": "spot", "position": [1, 2, 3], "direction": [0, -2, 0], "intensity": [1, 1, 1],
         "cone": 60, "blend": 0.5},
        {"type": "rectangle", "position": [1, 2, 3], "direction": [0, 0, 1], "size": [0.6, 1.2],
         "radiance": [5, 5, 5]},
        {"type": "disc", "position": [1, 2, 3], "direction": [1, 0, 0], "radius": 0.2,
         "radiance": [5, 5, 5]},
        {"type": "sphere", "position": [1, 2, 3], "radius": 0.1, "radiance": [5, 5, 5]},
        {"type": "sun", "direction": [1, -1, 0], "irradiance": [9, 9, 8]},
        {"position": [1, 2, 3], "intensity": [3, 2, 1], "on": false},
        {"position": [1, 2, 3], "intensity": [3, 2, 1], "dim": 0.5}
    ], "sky": {"radiance": [0.1, 0.2, 0.3]}})");
    EXPECT_THAT(lastWarnings, IsEmpty());
    ASSERT_THAT(lighting.lights, SizeIs(8));
    EXPECT_EQ(lighting.lights[0].emission, glm::vec3(3, 2, 1));
    EXPECT_NEAR(lighting.lights[1].cone, kPi / 6.0f, 1e-5f);
    EXPECT_NEAR(lighting.lights[1].direction.y, -1.0f, 1e-6f);
    EXPECT_EQ(lighting.lights[2].size, glm::vec2(0.6f, 1.2f));
    EXPECT_EQ(lighting.lights[5].type, LightType::sun);
    EXPECT_EQ(lighting.lights[6].emission, glm::vec3(0.0f));
    EXPECT_EQ(lighting.lights[7].emission, glm::vec3(1.5f, 1.0f, 0.5f));
    EXPECT_EQ(lighting.sky.radiance, glm::vec3(0.1f, 0.2f, 0.3f));
    for (const LitFixture& fixture : lighting.fixtures)
        EXPECT_EQ(fixture.fixture.radiance, glm::vec3(0.0f)); // off unless turned on
}

// 800 lm of a point are 800 / 4 pi cd; a matte disc of them sends lumens / (pi area) nits.
TEST(RelightingFile, LumensOfAKnownLamp)
{
    const Relighting lighting = read(R"({"lights": [
        {"position": [1, 2, 3], "lumens": 800},
        {"type": "disc", "position": [1, 2, 3], "direction": [0, -1, 0], "radius": 0.5, "lumens": 800},
        {"position": [1, 2, 3], "candela": 63.66},
        {"position": [1, 2, 3], "lumens": 800, "kelvin": 2700}]})");
    const PhotometricWhite white;
    const auto photometric = [&](size_t i) {
        return luminance(lighting.lights[i].emission) * white.luminance;
    };
    EXPECT_NEAR(photometric(0), 800.0f / (4.0f * kPi), 0.01f);
    EXPECT_NEAR(photometric(1), 800.0f / (kPi * kPi * 0.25f), 0.1f);
    EXPECT_NEAR(photometric(2), 63.66f, 0.01f);
    EXPECT_NEAR(photometric(3), photometric(0), 0.01f);
    EXPECT_GT(lighting.lights[3].emission.r, 1.5f * lighting.lights[3].emission.b);
}

TEST(RelightingFile, TurnsOnTheFixturesThatItNames)
{
    const Relighting lighting = read(R"({"fixtures": [
        {"id": 1, "dim": 0.5},
        {"centre": [1, 2.5, 1.005], "normal": [0, -1, 0], "area": 0.5, "radiance": [1, 2, 3], "on": true},
        {"centre": [9, 2.5, 1], "radiance": [1, 1, 1], "area": 0.2}]})");
    ASSERT_THAT(lighting.fixtures, SizeIs(3));
    EXPECT_EQ(lighting.fixtures[0].fixture.radiance, glm::vec3(1, 2, 3));
    EXPECT_EQ(lighting.fixtures[1].fixture.radiance, glm::vec3(10.0f));
    EXPECT_EQ(lighting.fixtures[2].fixture.centre.x, 9.0f);
    EXPECT_EQ(read(R"({"fixtures": "on"})").fixtures[0].fixture.radiance, glm::vec3(8, 6, 4));
    EXPECT_EQ(read(R"({"fixtures": "off; they do not shine"})").fixtures[0].fixture.radiance,
              glm::vec3(0.0f));
}

// Of two that stand at one place the number tells which is meant.
TEST(RelightingFile, GoesByNumbersWhateverTheOrder)
{
    Lights captured = twoFixtures();
    captured.fixtures[0].id = 8;
    captured.fixtures[1].id = 3;
    Lights turned = captured;
    std::swap(turned.fixtures[0], turned.fixtures[1]);
    std::vector<std::string> warnings;
    RelightingReader reader;
    const Relighting lighting =
        reader.read(lightsAsJson(turned), "lights.json", captured, warnings);
    EXPECT_THAT(warnings, IsEmpty());
    ASSERT_THAT(lighting.fixtures, SizeIs(2));
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(lighting.fixtures[i].fixture.id, captured.fixtures[i].id);
        EXPECT_EQ(lighting.fixtures[i].fixture.radiance, captured.fixtures[i].radiance);
    }
}

TEST(RelightingFile, SaysThatFixturesWithoutANumberAreKnownByTheirPlaces)
{
    const char* const item = R"({"centre": [1, 2.5, 1], "normal": [0, -1, 0], "area": 0.5,
                                 "radiance": [1, 2, 3])";
    EXPECT_EQ(read(fmt::format(R"({{"fixtures": [{}}}]}})", item)).fixtures[0].fixture.radiance,
              glm::vec3(1, 2, 3));
    EXPECT_THAT(lastWarnings, ElementsAre(HasSubstr("known by their places")));
    // One that was carried elsewhere is another; the room's stays dark.
    const Relighting moved = read(R"({"fixtures": [
        {"id": 0, "centre": [2, 2.5, 1], "area": 0.5, "radiance": [1, 2, 3]}]})");
    EXPECT_THAT(lastWarnings, ElementsAre(HasSubstr("was moved away")));
    ASSERT_THAT(moved.fixtures, SizeIs(3));
    EXPECT_EQ(moved.fixtures[0].fixture.radiance, glm::vec3(0.0f));
    EXPECT_EQ(moved.fixtures[2].fixture.id, -1);
}

TEST(RelightingFile, TakesWhatDelightWrites)
{
    Lights captured = twoFixtures();
    captured.points.push_back({{1, 2.4f, 1}, {0, -1, 0}, {1, 0.75f, 0.5f}, 0.1f, 0});
    captured.ambient = {0.1f, 0.1f, 0.2f};
    const Relighting lighting = read(lightsAsJson(captured));
    EXPECT_THAT(lastWarnings, IsEmpty());
    EXPECT_THAT(lighting.lights, IsEmpty()); // the fixture shines, not what stands for it
    EXPECT_EQ(lighting.fixtures[0].fixture.radiance, glm::vec3(8, 6, 4));
    EXPECT_EQ(lighting.sky.radiance, captured.ambient);
}

TEST(RelightingFile, WarnsOfWhatItPassesOver)
{
    read(R"({"x-made": "by hand", "lights": [{"position": [1, 2, 3], "intensity": [1, 1, 1],
          "x-note": 1}]})");
    EXPECT_THAT(lastWarnings, ElementsAre(HasSubstr("\"x-made\""), HasSubstr("\"x-note\"")));
}

TEST(RelightingFile, NamesTheLineAndTheKeyOfWhatIsWrong)
{
    EXPECT_THAT(
        refusalOfLights(
            "{\n\"lights\": [\n {\"position\": [1, 2, 3],\n  \"intensity\": [1, -1, 1]}\n]}"),
        AllOf(HasSubstr("lamps.json: light 0: \"intensity\""), HasSubstr("(line 4)")));
    const std::string place = R"("position": [1, 2, 3], )";
    const std::string shine = place + R"("intensity": [1, 1, 1])";
    EXPECT_THAT(refusalOfLight(R"("intensity": [1, 1, 1])"),
                AllOf(HasSubstr("\"position\" is missing"), HasSubstr("(line 3)")));
    EXPECT_THAT(refusalOfLight(place + R"("type": "lava")"), HasSubstr("\"type\" is \"lava\""));
    EXPECT_THAT(refusalOfLight(place + R"("type": 7)"), HasSubstr("\"type\""));
    EXPECT_THAT(refusalOfLight(place + R"("name": "x")"), HasSubstr("needs \"intensity\""));
    EXPECT_THAT(refusalOfLight(shine + R"(, "lumens": 3)"), HasSubstr("more than one of"));
    EXPECT_THAT(refusalOfLight(place + R"("lumens": -3)"), HasSubstr("\"lumens\" must not be"));
    EXPECT_THAT(refusalOfLight(place + R"("lumens": 3, "kelvin": 12)"), HasSubstr("\"kelvin\""));
    EXPECT_THAT(refusalOfLight(shine + R"(, "type": "spot")"),
                HasSubstr("\"direction\" is missing"));
    EXPECT_THAT(refusalOfLight(shine + R"(, "type": "spot", "direction": [0, 0, 0])"),
                HasSubstr("\"direction\" has no length"));
    EXPECT_THAT(refusalOfLight(shine + R"(, "type": "spot", "direction": [1, 0, 0], "cone": 400)"),
                HasSubstr("\"cone\" must lie"));
    EXPECT_THAT(refusalOfLight(place + R"("type": "disc", "direction": [1, 0, 0], "radius": 0)"),
                HasSubstr("\"radius\" must be greater"));
    EXPECT_THAT(
        refusalOfLight(place + R"("type": "rectangle", "direction": [1, 0, 0], "size": [1])"),
        HasSubstr("\"size\""));
    EXPECT_THAT(refusalOfLight(shine + R"(, "on": "yes")"), HasSubstr("\"on\" must be true"));
    EXPECT_THAT(refusalOfLight(place + R"("ies": "nowhere.ies")"), HasSubstr("nowhere.ies"));
    EXPECT_THAT(refusalOfLights(R"({"fixtures": [{"name": "window 2"}]})"),
                HasSubstr("the room's fixtures are: fixture 0, fixture 1"));
    EXPECT_THAT(refusalOfLights(R"({"fixtures": [{"id": 2}]})"),
                HasSubstr("the room's fixtures are: fixture 0, fixture 1"));
    EXPECT_THAT(refusalOfLights(R"({"fixtures": [{"dim": 2}]})"), HasSubstr("needs an \"id\""));
    EXPECT_THAT(refusalOfLights(R"({"fixtures": "bright"})"), HasSubstr("must be \"on\", \"off\""));
    EXPECT_THAT(refusalOfLights(R"({"sky": 3})"), HasSubstr("\"sky\" must be an object"));
    EXPECT_THAT(refusalOfLights(R"({"sky": {"environment": "no.exr"}})"), HasSubstr("no.exr"));
    EXPECT_THAT(refusalOfLights("{\n\"lights\": [}"), HasSubstr("line 2"));
}

TEST(RelightingReader, ReadsWhatTextsNameOnce)
{
    const scenes::TemporaryFolder folder;
    Image sky;
    sky.width = 2;
    sky.height = 1;
    sky.rgb = std::vector<uint8_t>{0, 0, 0, 255, 255, 255};
    Progress progress;
    writeImage(sky, folder / "sky.png", progress);
    std::vector<std::string> warnings;
    RelightingReader reader;
    const auto read = [&](const char* turn) {
        return reader
            .read(std::string(R"({"sky": {"environment": "sky.png", "turn": )") + turn + "}}",
                  folder / "lights.json", twoFixtures(), warnings)
            .sky;
    };
    const Sky first = read("0");
    const Sky second = read("90");
    EXPECT_EQ(first.environment, second.environment);
    EXPECT_GT(second.turn, first.turn);
}

TEST(FixtureSetting, DoesWhatAPersonSays)
{
    const Lights captured = twoFixtures();
    Relighting lighting = darkened(captured);
    const auto radiance = [&](size_t i) { return lighting.fixtures[i].fixture.radiance; };
    setFixture(lighting, captured, "all=on");
    EXPECT_EQ(radiance(0), glm::vec3(8, 6, 4));
    EXPECT_EQ(radiance(1), glm::vec3(20.0f));
    setFixture(lighting, captured, "1=off");
    EXPECT_EQ(radiance(1), glm::vec3(0.0f));
    setFixture(lighting, captured, "0=50%");
    EXPECT_EQ(radiance(0), glm::vec3(4, 3, 2));
    setFixture(lighting, captured, "1=2700K,800lm");
    EXPECT_NEAR(luminance(radiance(1)) * PhotometricWhite{}.luminance, 800.0f / (kPi * 0.1f), 1.0f);
    EXPECT_GT(radiance(1).r, radiance(1).b);
    setFixture(lighting, captured, "0=window");
    EXPECT_TRUE(lighting.fixtures[0].isWindow);
    EXPECT_EQ(radiance(0), glm::vec3(0.0f));
}

TEST(FixtureSetting, KnowsAFixtureByItsNumberAndItsName)
{
    Lights captured = twoFixtures();
    captured.fixtures[0].id = 5;
    captured.fixtures[1].id = 0;
    captured.fixtures[1].name = "window 0";
    Relighting lighting = darkened(captured);
    setFixture(lighting, captured, "5=on");
    EXPECT_EQ(lighting.fixtures[0].fixture.radiance, captured.fixtures[0].radiance);
    EXPECT_EQ(lighting.fixtures[1].fixture.radiance, glm::vec3(0.0f));
    setFixture(lighting, captured, "Window 0=on");
    EXPECT_EQ(lighting.fixtures[1].fixture.radiance, captured.fixtures[1].radiance);
    setFixture(lighting, captured, "0=off");
    EXPECT_EQ(lighting.fixtures[1].fixture.radiance, glm::vec3(0.0f));
}

TEST(FixtureSetting, OtherSayingsAreExplained)
{
    for (const char* setting : {"", "on", "0", "0=", "0=bright", "0=2700K,", "0=K", "0=12K",
                                "0=nanlm", "0=-3lm", "0=1e99lm"})
        EXPECT_THAT(refusalOfSetting(setting), HasSubstr("N=off, N=on")) << setting;
    for (const char* setting : {"2=on", "x=on", "-1=on", "=on"})
        EXPECT_THAT(refusalOfSetting(setting), HasSubstr("the room's are: fixture 0, fixture 1"))
            << setting;
    EXPECT_THAT(refusalOfSetting("99999999999999999999999=on"), HasSubstr("--fixture"));
}

} // namespace relamp
