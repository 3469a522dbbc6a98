#include "relamp/light_probes.h"

#include "base/half.h"
#include "relight/relighter_state.h"
#include "scenes/lit_room.h"
#include "scenes/scenes.h"

#include <cmath>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

/// An empty room whose texture is its albedo, and a bulb in it.
struct BulbInRoom
{
    DelitRoom room;
    Relighting lighting;
    Progress progress;

    BulbInRoom()
    {
        room.scan = std::make_shared<const Scan>(
            scenes::room(scenes::LitRoom::kSize, 96, scenes::LitRoom::albedo));
        room.albedo.push_back(room.scan->pages[0].image);
        room.isLit = false;
        lighting.lights.push_back({.emission = {2.0f, 1.0f, 0.5f}, .position = {1.2f, 1.4f, 1.8f}});
    }
};

std::vector<SurfacePlace> placesOf(const Texels& texels)
{
    std::vector<SurfacePlace> places;
    for (size_t i = 0; i < texels.pages[0].count(); ++i) {
        const TexelSite site = texels.siteOf(0, i);
        places.push_back({site.position, site.normal});
    }
    return places;
}

// Without anything in the way a glance misses nothing but what changes within a surfel.
TEST(LightProbes, AGlanceIsTheLightOfTexels)
{
    BulbInRoom bulb;
    Relighter relighter(bulb.room, {}, bulb.progress);
    const Texels& texels = relighter.state().texels;
    const LightProbes probes(relighter, placesOf(texels));
    relighter.glance(bulb.lighting, bulb.progress);
    const std::vector<LightAtPlace> glanced = probes.light(relighter);
    relighter.light(bulb.lighting, bulb.progress);
    const Image radiance = relighter.radiance(0, bulb.progress);

    const Radiance albedo(bulb.room.albedo[0]);
    double off = 0.0;
    double all = 0.0;
    for (size_t i = 0; i < glanced.size(); ++i) {
        const uint32_t pixel = texels.pages[0].pixel[i];
        const float exact = floatFromHalf(radiance.half()[3 * size_t{pixel} + 1]);
        off += std::pow(exact - glanced[i].shading.g * albedo[pixel].g, 2.0);
        all += std::pow(exact, 2.0);
    }
    EXPECT_LT(std::sqrt(off / all), 0.05);
}

// The slow half of relighting takes over what the quick half has found, and changes nothing of it.
TEST(LightProbes, TexelsAreTheSameAfterAGlance)
{
    BulbInRoom bulb;
    Relighter relighter(bulb.room, {}, bulb.progress);
    relighter.light(bulb.lighting, bulb.progress);
    const Image alone = relighter.radiance(0, bulb.progress);
    Relighting elsewhere = bulb.lighting;
    elsewhere.lights[0].position = {0.5f, 0.5f, 0.5f};
    relighter.glance(elsewhere, bulb.progress);
    relighter.glance(bulb.lighting, bulb.progress);
    relighter.light(bulb.lighting, bulb.progress);

    EXPECT_EQ(relighter.radiance(0, bulb.progress).half(), alone.half());
}

TEST(LightProbes, FarFromTheRoomItIsDark)
{
    BulbInRoom bulb;
    Relighter relighter(bulb.room, {}, bulb.progress);
    relighter.glance(bulb.lighting, bulb.progress);
    const std::vector<SurfacePlace> outside{{{50, 50, 50}, {0, 1, 0}}};

    EXPECT_EQ(LightProbes(relighter, outside).light(relighter)[0].shading, glm::vec3(0.0f));
}

} // namespace
} // namespace relamp
