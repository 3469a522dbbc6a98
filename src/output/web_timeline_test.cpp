#include "output/web_timeline.h"

#include "relamp/lightmaps.h"
#include "scenes/lit_room.h"
#include "scenes/refusal.h"
#include "scenes/temporary_folder.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

/// The lit room of the tests under its panel, a sun and a sky, from morning to noon.
class WebTimeline : public testing::Test
{
protected:
    WebTimeline() : room(scenes::litDelitRoom("panel"))
    {
        lighting = asCaptured(room.captured);
        lighting.lights.push_back(
            {.type = LightType::sun, .emission = glm::vec3(3.0f), .direction = {0.6f, -0.8f, 0}});
        lighting.sky.radiance = {0.1f, 0.2f, 0.4f};
    }

    json of(const std::string& morning, const std::string& noon)
    {
        const std::string text =
            R"({"seconds": 5, "keys": [{"time": 6, "name": "morning", "light": )" + morning +
            R"(}, {"time": 12, "light": )" + noon + "}]}";
        const Timeline timeline(folder.write("day.json", text), room.captured, warnings);
        return webTimeline(timeline, lighting);
    }

    std::string refusal(const std::string& morning, const std::string& noon)
    {
        return scenes::refusalOf([&] { of(morning, noon); });
    }

    DelitRoom room;
    Relighting lighting;
    const scenes::TemporaryFolder folder;
    std::vector<std::string> warnings;
};

std::string sunAndSky(const std::string& sun, const std::string& sky)
{
    return R"({"sun": {"direction": [-0.6, 0.8, 0], "irradiance": )" + sun +
           R"(}, "sky": {"radiance": )" + sky + "}}";
}

} // namespace

TEST_F(WebTimeline, HasWhatEachLightGivesOfItsLightmap)
{
    const json timeline =
        of(sunAndSky("[0, 0, 0]", "[0.1, 0.1, 0.1]"), sunAndSky("[6, 3, 1.5]", "[0.2, 0.2, 0.2]"));
    EXPECT_EQ(timeline["seconds"], 5.0);
    EXPECT_EQ(timeline["keys"][0], json({{"time", 6.0}, {"name", "morning"}}));
    EXPECT_EQ(timeline["keys"][1], json({{"time", 12.0}}));
    ASSERT_EQ(timeline["times"].size(), timeline["weights"].size());
    EXPECT_EQ(timeline["times"][4], 9.0);
    const json middle = timeline["weights"][4];
    ASSERT_EQ(middle.size(), 3u); // the panel is off, the sun and the sky are apart
    EXPECT_EQ(middle[0], json({0.0, 0.0, 0.0}));
    EXPECT_EQ(middle[1], json({1.0, 0.5, 0.25}));
    EXPECT_EQ(middle[2], json({1.5, 0.75, 0.375}));
}

TEST_F(WebTimeline, WhatNoMixtureOfTheLightmapsIsIsRefused)
{
    const std::string sky = "[0.1, 0.1, 0.1]";
    const std::string sun = sunAndSky("[6, 3, 1.5]", sky);
    const std::string later = R"({"sun": {"direction": [0, -1, 0], "irradiance": [6, 3, 1.5]}, )"
                              R"("sky": {"radiance": [0.1, 0.1, 0.1]}})";
    EXPECT_THAT(refusal(sun, later), HasSubstr("or moves one"));
    const std::string bulb = R"({"lights": [{"position": [1, 1, 1], "intensity": [1, 1, 1]}]})";
    EXPECT_THAT(refusal(bulb, bulb), HasSubstr("day.json: brings other lights"));
    lighting.fixtures[0].fixture.radiance = glm::vec3(0.0f);
    const std::string panel = R"({"fixtures": [{"id": 7}]})";
    EXPECT_THAT(refusal(panel, panel), HasSubstr("turns on a light that is off"));
}

} // namespace relamp
