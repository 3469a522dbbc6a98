#include "relamp/timeline.h"

#include "scenes/refusal.h"
#include "scenes/temporary_folder.h"

#include <filesystem>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class TimelineFile : public testing::Test
{
protected:
    TimelineFile()
    {
        captured_.fixtures = {{.area = 0.5f, .radiance = glm::vec3(8.0f), .id = 0},
                              {.area = 0.5f, .radiance = glm::vec3(4.0f), .id = 6}};
    }

    Timeline read(const std::string& text)
    {
        return {folder.write("day.json", text), captured_, warnings};
    }

    /// A timeline of two keys, 6 and 18 o'clock.
    Timeline between(const std::string& first, const std::string& second)
    {
        return read("{\"keys\": [{\"time\": 6, \"light\": " + first +
                    "},\n{\"time\": 18, \"light\": " + second + "}]}");
    }

    std::string refusal(const std::string& text)
    {
        return scenes::refusalOf([&] { read(text); });
    }

    std::string refusalBetween(const std::string& first, const std::string& second)
    {
        return scenes::refusalOf([&] { between(first, second); });
    }

    scenes::TemporaryFolder folder;
    std::vector<std::string> warnings;

private:
    Lights captured_;
};

/// Lights with one of this.
std::string oneLight(const std::string& light)
{
    return R"({"lights": [{"position": [1, 2, 3], )" + light + "}]}";
}

} // namespace

// Halfway between 2 and 6 is 4, halfway between two places is the middle of them.
TEST_F(TimelineFile, LightAndPlacesChangeEvenly)
{
    const Timeline timeline =
        between(R"({"lights": [{"position": [1, 2, 3], "intensity": [2, 0, 1]}]})",
                R"({"lights": [{"position": [3, 2, 1], "intensity": [6, 1, 1]}]})");
    const NewLight light = timeline.at(0.5).lights.at(0);
    EXPECT_EQ(light.emission, glm::vec3(4.0f, 0.5f, 1.0f));
    EXPECT_EQ(light.position, glm::vec3(2.0f, 2.0f, 2.0f));
    EXPECT_EQ(timeline.at(0.0).lights.at(0).emission, glm::vec3(2.0f, 0.0f, 1.0f));
    EXPECT_EQ(timeline.at(1.0).lights.at(0).emission, glm::vec3(6.0f, 1.0f, 1.0f));
    EXPECT_EQ(timeline.seconds(), 10.0);
    EXPECT_THAT(warnings, IsEmpty());
}

// Between 2000 K (500 mired) and 5000 K (200 mired) lies 350 mired, not 3500 K.
TEST_F(TimelineFile, ColourTemperatureChangesInMired)
{
    const Timeline timeline = between(oneLight(R"("lumens": 800, "kelvin": 2000)"),
                                      oneLight(R"("lumens": 800, "kelvin": 5000)"));
    const std::string same = oneLight(R"("lumens": 800, "kelvin": 2857.142857142857)");
    const glm::vec3 expected = between(same, same).at(0.0).lights.at(0).emission;
    EXPECT_LT(glm::length(timeline.at(0.5).lights.at(0).emission - expected), 1e-5f);
}

// The same profile in all frames: shadows are found anew where it is another.
TEST_F(TimelineFile, NamedFilesAreReadOnce)
{
    folder.write("lamp.ies", std::string("IESNA91\nTILT=NONE\n1 1000 1 2 1 1 2 0 0 0 1 1 60\n"
                                         "0 180\n0\n50 50\n"));
    const Timeline timeline = between(oneLight(R"("ies": "lamp.ies", "dim": 0.2)"),
                                      oneLight(R"("ies": "lamp.ies", "dim": 1)"));
    std::filesystem::remove(folder / "lamp.ies");
    const NewLight early = timeline.at(0.1).lights.at(0);
    const NewLight late = timeline.at(0.9).lights.at(0);
    ASSERT_TRUE(early.profile);
    EXPECT_EQ(early.profile, late.profile);
    EXPECT_LT(early.emission.g, late.emission.g);
}

TEST_F(TimelineFile, FixturesAreDimmedEvenlyAndSwitchedAtTheKey)
{
    const Timeline dimmed =
        between(R"({"fixtures": [{"id": 0}]})", R"({"fixtures": [{"id": 0, "dim": 0.5}]})");
    EXPECT_EQ(dimmed.at(0.5).fixtures.at(0).fixture.radiance.g, 6.0f);
    const Timeline switched =
        between(R"({"fixtures": [{"id": 0, "on": false}]})", R"({"fixtures": [{"id": 0}]})");
    EXPECT_EQ(switched.at(0.99).fixtures.at(0).fixture.radiance.g, 0.0f);
    EXPECT_EQ(switched.at(1.0).fixtures.at(0).fixture.radiance.g, 8.0f);
}

// Two people wrote the keys, or two programs.
TEST_F(TimelineFile, FixturesOfTwoKeysAreMatchedByTheirNumbers)
{
    const Timeline timeline = between(R"({"fixtures": [{"id": 0}, {"id": 6, "dim": 0.5}]})",
                                      R"({"fixtures": [{"id": 6, "dim": 1.5}, {"id": 0}]})");
    EXPECT_EQ(timeline.at(0.5).fixtures.at(0).fixture.radiance.g, 8.0f);
    EXPECT_EQ(timeline.at(0.5).fixtures.at(1).fixture.radiance.g, 4.0f);
    EXPECT_THAT(refusalBetween(R"({"fixtures": [{"id": 0}]})", R"({"fixtures": [{"id": 6}]})"),
                HasSubstr("\"fixtures/0\" is in one of this and"));
}

TEST_F(TimelineFile, KeysNeedNotBeEvenlySpread)
{
    const Timeline timeline = read(R"({"format": "relamp timeline 1", "seconds": 4, "keys": [
        {"time": 0, "light": {"ambient": [0, 0, 0]}},
        {"time": 1, "light": {"ambient": [1, 1, 1]}},
        {"time": 4, "light": {"ambient": [4, 4, 4]}}]})");
    for (const float part : {0.0f, 0.125f, 0.25f, 0.5f, 1.0f})
        EXPECT_NEAR(timeline.at(part).sky.radiance.g, 4.0f * part, 1e-6f);
    EXPECT_EQ(timeline.seconds(), 4.0);
}

TEST_F(TimelineFile, AKeyMayBeALightsFileBesideIt)
{
    folder.write("noon.json", R"({"ambient": [3, 3, 3], "season": "summer"})");
    const Timeline timeline =
        between(R"({"ambient": [1, 1, 1], "season": "summer"})", R"("noon.json")");
    EXPECT_EQ(timeline.at(0.5).sky.radiance.g, 2.0f);
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("season"), HasSubstr("noon.json: \"season\"")));
}

TEST_F(TimelineFile, WhatDoesNotFitTogetherIsRefusedWithLineAndKey)
{
    EXPECT_THAT(refusalBetween(oneLight(R"("intensity": [1, 1, 1])"), R"({"lights": []})"),
                HasSubstr("\"lights\" has 1 entries, and 0 in"));
    EXPECT_THAT(refusalBetween(oneLight(R"("lumens": 1)"), oneLight(R"("candela": 1)")),
                HasSubstr("\"lights/0/candela\" is in one of this and"));
    EXPECT_THAT(refusalBetween("{}", "7"), HasSubstr("\"light\" must be an object"));
    EXPECT_THAT(refusalBetween("{}", "7"), HasSubstr("(line 2)"));
    EXPECT_THAT(refusalBetween("{}", R"("dusk.json")"), HasSubstr("dusk.json"));
    EXPECT_THAT(refusalBetween("{}", oneLight(R"("lumens": -1)")), HasSubstr("key 1"));
    EXPECT_THAT(refusal(R"({"keys": [{"time": 1, "light": {}}]})"), HasSubstr("two or more"));
    EXPECT_THAT(refusal("{}"), HasSubstr("two or more"));
    EXPECT_THAT(refusal(R"({"keys": [{"time": 1, "light": {}}, {"time": 1, "light": {}}]})"),
                HasSubstr("later than"));
    EXPECT_THAT(refusal(R"({"keys": [{"light": {}}]})"), HasSubstr("\"time\" is missing"));
    EXPECT_THAT(refusal(R"({"keys": [{"time": 1}]})"), HasSubstr("\"light\" is missing"));
    EXPECT_THAT(refusal(R"({"seconds": 0})"), HasSubstr("\"seconds\" must be greater than 0"));
}

} // namespace relamp
