#include "light_document.h"

#include "relamp/error.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace
{

relamp::Lights twoFixtures()
{
    relamp::Lights lights;
    lights.fixtures.push_back({{0, 2, 0}, {0, -1, 0}, 0.1f, glm::vec3(20.0f)});
    lights.fixtures.push_back({{1, 2, 0}, {0, -1, 0}, 0.2f, glm::vec3(10.0f)});
    lights.ambient = glm::vec3(0.25f);
    return lights;
}

TEST(LightDocument, AsItWasFoundIsTheLightOfTheScan)
{
    std::vector<std::string> notes;
    const relamp::Lights captured = twoFixtures();

    relamp::RelightingReader reader;
    const relamp::Relighting light = lightingOf(documentOf(captured), {}, captured, notes, reader);

    EXPECT_THAT(notes, testing::IsEmpty());
    ASSERT_EQ(light.fixtures.size(), 2u);
    EXPECT_EQ(light.fixtures[0].fixture.radiance, captured.fixtures[0].radiance);
    EXPECT_EQ(light.sky.radiance, captured.ambient);
}

TEST(LightDocument, SaysHowFixturesWereOnTheDayOfTheScan)
{
    const relamp::Lights found = twoFixtures();
    ScannedItems scanned{.fixtures = {kAsFound, kAsFound}};
    EXPECT_EQ(lightsUnder(scanned, {}, found).fixtures[0].radiance, found.fixtures[0].radiance);

    scanned.fixtures[0].dim = 0.5f;
    scanned.fixtures[1].on = false;
    const relamp::Lights lights = lightsUnder(scanned, {}, found);
    EXPECT_EQ(lights.fixtures[0].radiance, glm::vec3(10.0f));
    EXPECT_EQ(lights.fixtures[1].radiance, glm::vec3(0.0f));
    EXPECT_EQ(lights.ambient, found.ambient);
}

TEST(LightDocument, SaysHowSunAndSkyWereOnTheDayOfTheScan)
{
    relamp::Lights found = twoFixtures();
    found.sun = relamp::Sun{.irradiance = {4, 2, 1}};
    ScannedItems scanned{.fixtures = {kAsFound, kAsFound}};
    EXPECT_TRUE(scanned.isAsFound());
    EXPECT_EQ(lightsUnder(scanned, {}, found).sun->irradiance, found.sun->irradiance);

    scanned.sun = 0.5f;
    scanned.sunColour = {1, 1, 2};
    scanned.ambient = glm::vec3(0.25f);
    EXPECT_FALSE(scanned.isAsFound());
    const relamp::Lights lights = lightsUnder(scanned, {}, found);
    EXPECT_EQ(lights.sun->irradiance, glm::vec3(2, 1, 1));
    EXPECT_EQ(lights.ambient, glm::vec3(0.25f));
    EXPECT_EQ(lights.fixtures[0].radiance, found.fixtures[0].radiance);
    // A room that no sun shines into gets none.
    EXPECT_FALSE(lightsUnder(scanned, {}, twoFixtures()).sun);
}

TEST(LightDocument, TheRoomsOwnSkyFollowsTheDayOfTheScanAndOnesOwnDoesNot)
{
    relamp::Lights before = twoFixtures();
    before.sun = relamp::Sun{.irradiance = {4, 2, 1}};
    relamp::Lights after = before;
    after.sun->irradiance = glm::vec3(9.0f);
    after.ambient = glm::vec3(0.5f);
    LightDocument light = documentOf(before);
    followSky(light, before, after);
    EXPECT_EQ(light, documentOf(after));

    light.lamps[0].rgb = glm::vec3(1.0f);
    light.sky.radiance = glm::vec3(2.0f);
    const LightDocument ownSky = light;
    followSky(light, after, before);
    EXPECT_EQ(light, ownSky);
}

// A draft and the whole find the same lamps in another order, and one of them not all.
TEST(LightDocument, WhatWasSaidStaysWithTheFixtureOfThatNumber)
{
    const FixtureItem dimmed{.on = true, .dim = 0.5f};
    relamp::Lights found = twoFixtures();
    found.fixtures[0].id = 8;
    found.fixtures[1].id = 3;
    EXPECT_THAT(carriedOver({dimmed, {}}, {3, 5}, found, kAsFound),
                testing::ElementsAre(kAsFound, dimmed));
    EXPECT_THAT(numbersOf(found), testing::ElementsAre(8, 3));
}

TEST(LightDocument, IsReadAsItWasWritten)
{
    LightDocument document = documentOf(twoFixtures());
    document.fixtures[0] = {.on = false, .dim = 0.5f, .kelvin = 3000.0f, .window = true};
    LampItem spot{.name = "reading lamp", .type = relamp::LightType::spot, .position = {1, 2, 3}};
    spot.direction = glm::normalize(glm::vec3(1, -1, 0));
    LampItem panel{.type = relamp::LightType::rectangle, .unit = "nits", .amount = 300.0f};
    panel.byKelvin = false;
    panel.colour = {1.0f, 0.5f, 0.25f};
    LampItem sun{.type = relamp::LightType::sun, .unit = "irradiance", .rgb = glm::vec3(3.0f)};
    document.lamps = {spot, panel, sun};
    std::vector<std::string> notes;

    const LightDocument read =
        documentFrom(textOf(document, twoFixtures()), "lights.json", twoFixtures(), notes);

    EXPECT_THAT(notes, testing::IsEmpty());
    EXPECT_EQ(textOf(read, twoFixtures()), textOf(document, twoFixtures()));
    EXPECT_EQ(read.fixtures, document.fixtures);
}

TEST(LightDocument, WhatIsWrongIsSaidByTheLibrary)
{
    std::vector<std::string> notes;
    EXPECT_THROW(static_cast<void>(documentFrom("{\"lights\": [{\"type\": \"spot\"}]}", "a.json",
                                                twoFixtures(), notes)),
                 relamp::Error);
    EXPECT_THROW(static_cast<void>(lightTypeNamed("candle")), relamp::Error);
    // What relight does not read the viewer does, and so the library looks at it, too.
    for (const char* text :
         {R"({"lights": [{"position": [1, 1, 1], "intensity": [1, 1, 1], "name": 5}]})",
          R"({"fixtures": [{"id": "x", "centre": [0, 2, 0], "radiance": [1, 1, 1]}]})",
          R"({"fixtures": [{"id": 0, "name": []}]})"})
        EXPECT_THROW(static_cast<void>(documentFrom(text, "a.json", twoFixtures(), notes)),
                     relamp::Error)
            << text;
}

TEST(LightDocument, SwitchesAllFixturesByAWord)
{
    std::vector<std::string> notes;
    const LightDocument on = documentFrom("{\"fixtures\": \"on\"}", "a.json", twoFixtures(), notes);

    EXPECT_TRUE(on.fixtures[0].on && on.fixtures[1].on);
}

} // namespace
