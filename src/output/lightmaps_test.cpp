#include "relamp/lightmaps.h"

#include "base/half.h"
#include "scenes/lit_room.h"
#include "scenes/refusal.h"
#include "scenes/scenes.h"
#include "scenes/temporary_folder.h"

#include <cmath>
#include <fstream>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace relamp
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

glm::vec3 at(const Image& image, size_t pixel)
{
    return {floatFromHalf(image.half()[3 * pixel]), floatFromHalf(image.half()[3 * pixel + 1]),
            floatFromHalf(image.half()[3 * pixel + 2])};
}

/// The lit room of the tests under its panel, a bulb, the sun through a window, and a sky.
class Lightmaps : public testing::Test
{
protected:
    Lightmaps() : room_(scenes::litDelitRoom("panel/..\"7\""))
    {
        lighting = asCaptured(room_.captured);
        lighting.lights.push_back({.emission = {1.0f, 0.5f, 0.25f}, .position = {1, 1, 1}});
        lighting.lights.push_back({.type = LightType::sun,
                                   .emission = glm::vec3(3.0f),
                                   .direction = {0.8f, -0.6f, 0.0f}});
        lighting.sky.radiance = {0.1f, 0.2f, 0.4f};
    }

    Relighter& relighter()
    {
        if (!relighter_)
            relighter_ = std::make_unique<Relighter>(room_, RelightOptions{.rays = 16}, progress);
        return *relighter_;
    }

    [[nodiscard]] nlohmann::json list(const std::string& name) const
    {
        std::ifstream file(folder / name / "lightmaps.json");
        return nlohmann::json::parse(file);
    }

    Progress progress;
    Relighting lighting;
    const scenes::TemporaryFolder folder;

private:
    DelitRoom room_;
    std::unique_ptr<Relighter> relighter_;
};

} // namespace

TEST_F(Lightmaps, AddUpToTheLightOfAll)
{
    Relighter& one = relighter();
    one.light(lighting, progress);
    const Image whole = one.radiance(0, progress);
    std::vector<glm::vec3> sum(whole.pixels(), glm::vec3(0.0f));
    std::vector<std::string> names;
    for (const LightPart& part : partsOf(lighting, one)) {
        names.push_back(part.name);
        one.light(part.lighting, progress);
        const Image image = one.radiance(0, progress);
        for (size_t i = 0; i < sum.size(); ++i) sum[i] += at(image, i);
    }
    EXPECT_THAT(names, ElementsAre("panel/..\"7\"", "light 1", "sun", "sky"));
    double error = 0.0;
    double all = 0.0;
    for (size_t i = 0; i < sum.size(); ++i) {
        const glm::vec3 there = at(whole, i);
        if (there.g > 0.9f * scenes::LitRoom::kLampRadiance.g)
            continue; // a lamp that is off reflects
        error += glm::dot(sum[i] - there, sum[i] - there);
        all += glm::dot(there, there);
    }
    EXPECT_GT(all, 100.0);
    EXPECT_LT(std::sqrt(error / all), 0.005);
}

TEST_F(Lightmaps, TimesAlbedoAreTheRadiance)
{
    Relighter& one = relighter();
    lighting.fixtures[0].fixture.radiance = glm::vec3(0.0f); // nothing on a wall shines
    lighting.fixtures[0].isWindow = false;
    lighting.windowsAreSaid = true;
    one.light(lighting, progress);
    const Image radiance = one.radiance(0, progress);
    const Image shading = one.shading(0, 0, progress);
    ASSERT_EQ(shading.width, radiance.width);
    const Radiance albedo(one.room().albedo[0]);
    size_t compared = 0;
    for (size_t i = 0; i < radiance.pixels(); ++i) {
        const glm::vec3 paint = albedo[i];
        const glm::vec3 light = at(shading, i);
        for (int c = 0; c < 3; ++c) {
            if (paint[c] < 0.05f || light[c] < 0.01f) continue;
            EXPECT_NEAR(at(radiance, i)[c] / light[c] / paint[c], 1.0f, 0.02f) << i;
            ++compared;
        }
    }
    EXPECT_GT(compared, radiance.pixels());
}

TEST_F(Lightmaps, AreHalvedUntilTheyFit)
{
    Relighter& one = relighter();
    one.light(lighting, progress);
    const Image large = one.shading(0, 0, progress);
    const Image small = one.shading(0, large.width - 1, progress);
    EXPECT_EQ(small.width, (large.width + 1) / 2);
    EXPECT_EQ(small.height, (large.height + 1) / 2);
    const auto meanOf = [](const Image& image) {
        double sum = 0.0;
        for (size_t i = 0; i < image.pixels(); ++i) sum += at(image, i).g;
        return sum / static_cast<double>(image.pixels());
    };
    EXPECT_NEAR(meanOf(small) / meanOf(large), 1.0, 0.03);
}

TEST_F(Lightmaps, AreWrittenWithAListThatNamesTheirLights)
{
    writeLightmaps(relighter(), lighting, folder / "maps", {}, progress);
    const nlohmann::json found = list("maps");
    EXPECT_EQ(found["format"], "relamp lightmaps 1");
    ASSERT_EQ(found["lights"].size(), 4u);
    const nlohmann::json& panel = found["lights"][0];
    EXPECT_EQ(panel["fixture"], 7);
    EXPECT_EQ(panel["shines"][0]["fixture"], 7);
    EXPECT_FLOAT_EQ(panel["shines"][0]["radiance"][0].get<float>(),
                    scenes::LitRoom::kLampRadiance.r);
    EXPECT_EQ(panel["maps"][0]["file"], "00_panel____7_.exr"); // no way out of the folder
    for (const nlohmann::json& light : found["lights"])
        EXPECT_TRUE(
            std::filesystem::exists(folder / "maps" / light["maps"][0]["file"].get<std::string>()));
}

TEST_F(Lightmaps, OfEightBitsAreNearThoseOfHalfFloats)
{
    Relighter& one = relighter();
    writeLightmaps(one, lighting, folder / "maps", {.format = LightmapFormat::png}, progress);
    const nlohmann::json map = list("maps")["lights"][0]["maps"][0];
    const Image png = readImage(folder / "maps" / map["file"].get<std::string>());
    one.light(partsOf(lighting, one)[0].lighting, progress);
    const Image exact = one.shading(0, 0, progress);
    const auto scale = map["scale"].get<float>();
    for (size_t i = 0; i < exact.pixels(); ++i) {
        const float root = static_cast<float>(png.encoded()[3 * i + 1]) / 255.0f;
        EXPECT_NEAR(scale * std::pow(root, 4.0f), at(exact, i).g, 1e-6f + 0.03f * at(exact, i).g);
    }
}

TEST_F(Lightmaps, ReplaceTheirOwnFilesAlone)
{
    writeLightmaps(relighter(), lighting, folder / "maps", {}, progress);
    lighting.lights.clear();
    writeLightmaps(relighter(), lighting, folder / "maps", {}, progress);
    EXPECT_FALSE(std::filesystem::exists(folder / "maps" / "01_light_1.exr"));
    folder.write("maps/00_mine.exr", "painted by hand");
    EXPECT_THAT(scenes::refusalOf([&] { checkLightmaps(folder / "maps", {}); }),
                HasSubstr("00_mine.exr"));
    lighting = darkened(relighter().room().captured);
    EXPECT_THAT(scenes::refusalOf(
                    [&] { writeLightmaps(relighter(), lighting, folder / "dark", {}, progress); }),
                HasSubstr("no light is on"));
    EXPECT_FALSE(std::filesystem::exists(folder / "dark"));
}

} // namespace relamp
