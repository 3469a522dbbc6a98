#include "output/usd_scene.h"

#include "base/half.h"
#include "scenes/scenes.h"
#include "scenes/temporary_folder.h"

#include <fstream>
#include <sstream>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using testing::HasSubstr;
using testing::Not;

/// The square of a metre, its scene.
std::string sceneOf(const UsdLights& lights, const UsdPage& page = {.albedo = "albedo.png"})
{
    const scenes::TemporaryFolder folder;
    Scan scan = scenes::square(1.0f, 4, scenes::plain(glm::vec3(0.5f)));
    scan.meshes.front().name = "floor \"1\"";
    writeUsdScene(folder / "a.usda", scan, {page}, lights);
    std::ostringstream all;
    all << std::ifstream(folder / "a.usda").rdbuf();
    return all.str();
}

/// What stands between the braces of a prim.
std::string bodyOf(const std::string& scene, const std::string& prim)
{
    const size_t at = scene.find("def " + prim);
    return at == std::string::npos ? ""
                                   : scene.substr(at, scene.find("}\n", scene.find("\n", at)) - at);
}

} // namespace

TEST(UsdScene, LightsOfEveryKindHaveTheirSizesAndBrightness)
{
    UsdLights lights;
    lights.lamps = {{.name = "window 0",
                     .id = 0,
                     .shape = LampShape::rectangle,
                     .position = {1, 2, 3},
                     .width = 2.0f,
                     .height = 1.25f,
                     .emission = {5, 10, 2.5f}},
                    {.name = "ceiling lamp 2",
                     .shape = LampShape::disc,
                     .radius = 0.25f,
                     .emission = {3, 3, 3}},
                    {.name = "ceiling lamp 2", .radius = 0.125f, .emission = {1, 0, 0}}};
    lights.openings = {squareLamp({0, 1, 0}, {0, 0, 1}, 0.25f, {4, 4, 8})};
    lights.openings.front().name = "opening 1";
    lights.outside = {0.25f, 0.5f, 0.5f};
    lights.sun = Sun{.direction = {0, 1, 0}, .irradiance = {6, 3, 3}};
    const std::string scene = sceneOf(lights);

    const std::string window = scene.substr(scene.find("def RectLight \"window_0\""));
    EXPECT_THAT(window, HasSubstr("int fixture = 0\n"));
    EXPECT_THAT(window, HasSubstr("string name = \"window 0\"\n"));
    EXPECT_THAT(window, HasSubstr("color3f inputs:color = (0.5, 1, 0.25)\n"));
    EXPECT_THAT(window, HasSubstr("float inputs:intensity = 4\n"));
    EXPECT_THAT(window, HasSubstr("float inputs:height = 1.25\n"));
    EXPECT_THAT(window, HasSubstr("float inputs:width = 2\n"));
    EXPECT_THAT(window, HasSubstr("((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (1, 2, 3, 1))\n"));
    EXPECT_THAT(scene, HasSubstr("def DiskLight \"ceiling_lamp_2\""));
    EXPECT_THAT(scene, HasSubstr("float inputs:radius = 0.25\n"));
    EXPECT_THAT(scene, HasSubstr("def SphereLight \"ceiling_lamp_2_2\""));
    EXPECT_THAT(scene, HasSubstr("float inputs:radius = 0.125\n"));
    EXPECT_THAT(scene, HasSubstr("def RectLight \"opening_1\""));
    EXPECT_THAT(bodyOf(scene, "DomeLight \"outside\""),
                HasSubstr("float inputs:intensity = 0.5\n"));
    const std::string sun = bodyOf(scene, "DistantLight \"sun\"");
    EXPECT_THAT(sun, HasSubstr("float inputs:intensity = 6\n"));
    EXPECT_THAT(sun, HasSubstr("bool inputs:normalize = 1\n"));
    EXPECT_THAT(sun, HasSubstr(", (0, 1, 0, 0), (0, 0, 0, 1))\n")); // it shines against its z
}

// What shines lights the room in one variant, the lamps do in the other.
TEST(UsdScene, NothingLightsTwice)
{
    UsdLights lights;
    lights.lamps = {{.name = "lamp", .radius = 0.1f, .emission = {1, 1, 1}}};
    const std::string scene = sceneOf(lights, {.albedo = "albedo.png", .emission = "emission.exr"});
    const size_t emissive = scene.find("\"emissive\" {\n");
    const size_t lamps = scene.find("\"lamps\" {\n", emissive);
    ASSERT_NE(emissive, std::string::npos);
    ASSERT_NE(lamps, std::string::npos);
    EXPECT_LT(scene.find("def SphereLight"), emissive); // for programs that know no variants
    const std::string shining = scene.substr(emissive, lamps - emissive);
    EXPECT_THAT(shining, HasSubstr("over \"Lamps\" ("));
    EXPECT_THAT(shining, HasSubstr("active = false"));
    EXPECT_EQ(scene.find("inputs:emissiveColor"),
              emissive + shining.find("inputs:emissiveColor")); // here alone
    EXPECT_EQ(scene.find("inputs:emissiveColor", lamps), std::string::npos);
    EXPECT_THAT(scene, HasSubstr("string light = \"lamps\"\n"));
    EXPECT_THAT(scene, HasSubstr("asset inputs:file = @./emission.exr@\n"));
}

TEST(UsdScene, AMeshHasItsPlacesAndTextureCoordinatesUpwards)
{
    const std::string scene = sceneOf({});
    EXPECT_THAT(scene, HasSubstr("def Mesh \"floor__1_\" ("));
    EXPECT_THAT(scene, HasSubstr("string name = \"floor \\\"1\\\"\"\n"));
    EXPECT_THAT(scene, HasSubstr("float3[] extent = [(0, 0, 0), (1, 0, 1)]\n"));
    EXPECT_THAT(scene, HasSubstr("rel material:binding = </Room/Materials/page_0>\n"));
    EXPECT_THAT(scene,
                HasSubstr("(0, 1, 0)] (\n                interpolation = \"vertex\"\n")); // normals
    EXPECT_THAT(scene, HasSubstr("asset inputs:file = @./albedo.png@\n"));
    EXPECT_THAT(scene, Not(HasSubstr("inputs:opacity")));
    EXPECT_THAT(scene, Not(HasSubstr("Light \"")));
    // u = v = 0 at the corner (0, 0, 0) is the upper left of the page, t = 1.
    const auto first = [&](const std::string& key) {
        const size_t at = scene.find(key + " = [");
        return scene.substr(at, scene.find(')', at) - at + 1);
    };
    EXPECT_EQ(first("point3f[] points"), "point3f[] points = [(0, 0, 0)");
    EXPECT_EQ(first("texCoord2f[] primvars:st"), "texCoord2f[] primvars:st = [(0, 1)");
}

// The number in the map is the lamp's, not its place in the list.
TEST(UsdScene, TexelsOfALampSendItsRadiance)
{
    Lights lights;
    lights.fixtures = {
        {.radiance = {9, 9, 9}, .id = 4}, {.radiance = {8, 2, 0.5f}, .id = 1}, {.id = 7}};
    const FixtureMap map{
        .width = 5, .height = 1, .id = {FixtureMap::kNone, 1, FixtureMap::kWall, 7, 4}};
    const std::vector<uint16_t> emission = emissionBy(map, lights);
    std::vector<float> light;
    for (const uint16_t half : emission) light.push_back(floatFromHalf(half));
    EXPECT_THAT(light, testing::ElementsAre(0, 0, 0, 8, 2, 0.5f, 0, 0, 0, 0, 0, 0, 9, 9, 9));
    EXPECT_TRUE(emissionBy({.width = 1, .height = 1, .id = {7}}, lights).empty()); // it is off
}

} // namespace relamp
