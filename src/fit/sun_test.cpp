#include "fit/sun.h"

#include "base/half.h"
#include "base/radiometry.shared.h"
#include "relamp/delight.h"
#include "scenes/lit_room.h"
#include "scenes/sun_room.h"
#include "scenes/surfaces.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::Panel;
using scenes::SunRoom;

const glm::vec3 kBurning(60.0f, 52.0f, 40.0f); // irradiance on the floor; burns it out
const glm::vec3 kFaint(5.2f, 4.9f, 4.4f);      // does not

Decomposition solve(const Scan& scan, const DelightOptions& options = {})
{
    Progress progress;
    return delight(scenes::copyOf(scan), options, progress);
}

float degreesOff(const Sun& sun, glm::vec3 wanted = SunRoom::kTowardsSun)
{
    const float cosine = glm::dot(sun.direction, glm::normalize(wanted));
    return std::acos(std::min(cosine, 1.0f)) * 180.0f / kPi;
}

/// What the sun sends if all else on the floor is about `other`.
float ratioOf(const Sun& sun, glm::vec3 onFloor, float other, int channel)
{
    const float cosine = glm::normalize(SunRoom::kTowardsSun).y;
    return sun.irradiance[channel] * cosine / (onFloor[channel] - other);
}

/// Mean albedo of the floor, green, within the patch and beside it; direct light in the patch.
struct FloorAlbedo
{
    float inPatch = 0.0f;
    float beside = 0.0f;
    float direct = 0.0f; // irradiance / pi
    bool shines = false; // some of the patch is thought to

    FloorAlbedo(const SunRoom& room, const Decomposition& result)
    {
        Progress progress;
        const PageLayers layers = result.layers(0, progress);
        const Texels texels = rasterizeAtlas(room.scan, progress);
        const glm::vec3 centre = SunRoom::patchPanel().at(0.5f, 0.5f);
        float counts[2] = {};
        for (size_t i = 0; i < texels.pages[0].count(); ++i) {
            const TexelSite site = texels.siteOf(0, i);
            if (site.normal.y < 0.9f) continue;
            const float away = glm::distance(site.position, centre);
            const size_t pixel = texels.pages[0].pixel[i];
            const float albedo = floatFromHalf(layers.albedo[3 * pixel + 1]);
            if (away < 0.35f) {
                inPatch += albedo;
                direct += floatFromHalf(layers.direct[3 * pixel + 1]);
                counts[0] += 1.0f;
                shines |= layers.doubt[pixel] == Doubt::shines;
            } else if (away > 1.2f && away < 1.6f) {
                beside += albedo;
                counts[1] += 1.0f;
            }
        }
        inPatch /= counts[0];
        direct /= counts[0];
        beside /= counts[1];
    }
};

/// Share of the floor that is black.
float blackShare(const SunRoom& room, const Decomposition& result)
{
    Progress progress;
    const PageLayers layers = result.layers(0, progress);
    const Texels texels = rasterizeAtlas(room.scan, progress);
    float black = 0.0f;
    float count = 0.0f;
    for (size_t i = 0; i < texels.pages[0].count(); ++i) {
        if (texels.siteOf(0, i).normal.y < 0.9f) continue;
        const size_t pixel = texels.pages[0].pixel[i];
        black +=
            floatFromHalf(layers.albedo[3 * pixel + 1]) < 0.25f * SunRoom::kFloor.g ? 1.0f : 0.0f;
        count += 1.0f;
    }
    return black / count;
}

} // namespace

TEST(Sun, BurntOutPatchTellsWhereItStandsAndHowBrightItIs)
{
    const SunRoom room(kBurning);
    const Decomposition result = solve(room.scan);
    ASSERT_TRUE(result.lights().sun);
    const Sun& sun = *result.lights().sun;
    EXPECT_LT(degreesOff(sun), 1.0f);
    EXPECT_TRUE(sun.determined);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(ratioOf(sun, kBurning, 3.0f, c), 1.0f, 0.15f);
    EXPECT_EQ(result.lights().fixtures.size(), 1u); // the panel; the patch is none
    EXPECT_FALSE(FloorAlbedo(room, result).shines);
}

// One sun for a house, though each room is fitted by itself.
TEST(Sun, ShinesIntoEveryRoomOfAHouse)
{
    const SunRoom room(kFaint);
    const Decomposition result = solve(scenes::rowOf(room.scan, 2, 12.0f));
    ASSERT_TRUE(result.lights().sun);
    EXPECT_LT(degreesOff(*result.lights().sun), 1.0f);
    EXPECT_EQ(result.lights().fixtures.size(), 2u);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(ratioOf(*result.lights().sun, kFaint, 1.2f, c), 1.0f, 0.1f);
    const FloorAlbedo floor(room, result); // of the first
    EXPECT_NEAR(floor.inPatch, floor.beside, 0.1f * floor.beside);
}

TEST(Sun, PatchIsDividedOutWhereItIsNotBurntOut)
{
    const SunRoom room(kFaint);
    const Decomposition result = solve(room.scan);
    ASSERT_TRUE(result.lights().sun);
    EXPECT_LT(degreesOff(*result.lights().sun), 1.0f);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(ratioOf(*result.lights().sun, kFaint, 1.2f, c), 1.0f, 0.1f);
    const FloorAlbedo floor(room, result);
    EXPECT_NEAR(floor.beside, SunRoom::kFloor.g, 0.1f * SunRoom::kFloor.g);
    EXPECT_NEAR(floor.inPatch, floor.beside, 0.1f * floor.beside);
}

TEST(Sun, PathsDivideThePatchOutToo)
{
    const SunRoom room(kFaint);
    const Decomposition result =
        solve(room.scan, {.solver = Solver::pathtrace, .pathtrace = {.samples = 16}});
    ASSERT_TRUE(result.lights().sun);
    EXPECT_THAT(result.warnings(), testing::Not(testing::Contains(testing::HasSubstr("sun"))));
    const FloorAlbedo floor(room, result);
    EXPECT_NEAR(floor.inPatch, floor.beside, 0.1f * floor.beside);
}

TEST(Sun, IsFoundAnywhereInTheSky)
{
    for (const glm::vec3 towards :
         {glm::vec3(1, 0.6f, -0.2f), glm::vec3(1, 1.2f, 0), glm::vec3(1, 2, 0.8f)})
        for (const glm::vec3 irradiance : {kBurning, kFaint}) {
            const Decomposition result = solve(SunRoom(irradiance, 0.0f, towards).scan);
            EXPECT_TRUE(result.lights().sun) << towards.y << " " << irradiance.x;
            if (!result.lights().sun) continue;
            EXPECT_LT(degreesOff(*result.lights().sun, towards), 2.0f)
                << towards.y << " " << irradiance.x;
        }
}

TEST(Sun, ShinesThroughAPane)
{
    const SunRoom room(kBurning, 6.0f);
    const Decomposition result = solve(room.scan);
    ASSERT_TRUE(result.lights().sun);
    EXPECT_LT(degreesOff(*result.lights().sun), 2.0f);
    EXPECT_EQ(result.lights().fixtures.size(), 2u); // panel and pane
}

// Neither window nor sheet nor panel make a sun of themselves.
TEST(Sun, IsNotSeenWhereNoneShinesIn)
{
    EXPECT_FALSE(solve(SunRoom(glm::vec3(0.0f)).scan).lights().sun);
    EXPECT_FALSE(solve(SunRoom(glm::vec3(0.0f), 6.0f).scan).lights().sun);
    EXPECT_FALSE(solve(scenes::LitRoom().scan).lights().sun);
}

TEST(Sun, IsNotLookedForWhereAPersonSaysSo)
{
    const Decomposition result = solve(SunRoom(kBurning).scan, {.gather = {.sun = false}});
    EXPECT_FALSE(result.lights().sun);
    EXPECT_EQ(result.lights().fixtures.size(), 2u); // the panel, and the patch for want of a sun
}

// A white rug just where the sun would throw its patch, on a dark floor: no brighter than paint.
TEST(Sun, IsNoRugPaintedLikeItsPatch)
{
    const auto albedo = [](glm::vec3 place, glm::vec3 normal) {
        const Panel rug = SunRoom::patchPanel();
        const glm::vec3 way = place - rug.corner;
        const float u = glm::dot(way, rug.alongU) / glm::dot(rug.alongU, rug.alongU);
        const float v = glm::dot(way, rug.alongV) / glm::dot(rug.alongV, rug.alongV);
        const bool isOnRug = normal.y > 0.5f && std::min(u, v) > 0.0f && std::max(u, v) < 1.0f;
        return isOnRug ? glm::vec3(0.85f) : 0.5f * SunRoom::albedo(place, normal);
    };
    EXPECT_FALSE(
        solve(SunRoom(glm::vec3(0.0f), 0.0f, SunRoom::kTowardsSun, albedo).scan).lights().sun);
}

// What a lamp of 1.2 m throws through the window from 5 m away has soft edges, and they part.
TEST(Sun, IsNoLampBehindAnOpening)
{
    const SunRoom dark(glm::vec3(0.0f));
    const Panel window = SunRoom::window();
    const Panel lamp{window.corner + glm::vec3(5.0f, 3.2f, 0.0f), {0, 0, 1.2f}, {0, 1.2f, 0}};
    const auto irradianceAt = [&](glm::vec3 place, glm::vec3 normal) {
        constexpr int kAcross = 12;
        float sum = 0.0f;
        for (int i = 0; i < kAcross * kAcross; ++i) {
            const glm::vec3 way = lamp.at((static_cast<float>(i % kAcross) + 0.5f) / kAcross,
                                          (static_cast<float>(i / kAcross) + 0.5f) / kAcross) -
                                  place;
            const float share = (window.corner.x - place.x) / way.x; // of it, to the window
            const glm::vec3 through = place + share * way - window.corner;
            const bool isSeen = std::min(through.y, through.z) > 0.0f &&
                                through.y < window.alongV.y && through.z < window.alongU.z;
            const float distance2 = glm::dot(way, way);
            if (isSeen)
                sum += std::max(glm::dot(way, normal), 0.0f) * way.x / (distance2 * distance2);
        }
        constexpr float kRadiance = 440.0f;
        return kRadiance * 1.44f * sum / (kAcross * kAcross);
    };
    const auto photo = [&](glm::vec3 place, glm::vec3 normal) {
        const glm::vec3 more = SunRoom::albedo(place, normal) * irradianceAt(place, normal) / kPi;
        return glm::min(dark.box.photo(place, normal) + more, 1.0f);
    };
    EXPECT_FALSE(solve(SunRoom::scanOf(photo)).lights().sun);
}

TEST(Sun, GivenOneIsBelieved)
{
    const SunRoom room(kBurning);
    Lights lights = solve(room.scan).lights();
    ASSERT_TRUE(lights.sun);
    const float once = FloorAlbedo(room, solve(room.scan, {.lights = lights})).direct;
    lights.sun->irradiance *= 2.0f;
    const float twice = FloorAlbedo(room, solve(room.scan, {.lights = lights})).direct;
    EXPECT_NEAR(twice, 2.0f * once, 0.03f * twice);
}

// Of a sun that stands 8 degrees higher the patch lies elsewhere. What is not burnt out there would
// be black paint in its light; a texel's width along the edge of the burnt-out patch still is.
TEST(Sun, DoesNotShineWhereThatWouldMakePaintBlack)
{
    const SunRoom room(kBurning);
    Lights lights = solve(room.scan).lights();
    ASSERT_TRUE(lights.sun);
    lights.sun->direction = glm::normalize(lights.sun->direction + glm::vec3(0, 0.15f, 0));
    EXPECT_LT(blackShare(room, solve(room.scan, {.lights = lights})), 0.02f);
}

// Four surfels that see all of the sun by rays, under light of 1 without it: grey paint in shade,
// sunlit grey paint, black paint, and one of which a quarter is burnt out and the rest in shade.
TEST(Sun, TextureTellsWhatLiesInShade)
{
    const Sun sun{.direction = {0, 1, 0}, .irradiance = glm::vec3(20.0f)};
    const float open = 1.0f / luminance(sunRadiance(sun)); // of which it sends an irradiance of 1
    LampSight onSides(std::vector<AreaSample>(4, {.open = 20.0f * open, .visible = 20.0f * open}));
    SurfelRadiance radiance;
    for (const float irradiance : {0.5f, 0.5f * 21.0f, 0.05f, 0.5f})
        radiance.plain.emplace_back(irradiance / kPi);
    radiance.plainArea = {1.0f, 1.0f, 1.0f, 0.75f};
    radiance.clippedArea = {0.0f, 0.0f, 0.0f, 0.25f};
    LitSides sides;
    sides.direct.assign(4, glm::vec3(1.0f));
    sides.gathered.irradiance.assign(4, glm::vec3(0.0f));
    markShade(sun, Texels{}, radiance, sides, onSides);
    std::vector<float> shares;
    for (size_t s = 0; s < onSides.size(); ++s)
        shares.push_back(onSides[s].visible / onSides[s].open);
    EXPECT_THAT(shares, testing::ElementsAre(0.0f, 1.0f, 1.0f, 0.25f));
}

TEST(Sun, DiscIsAsStrongAsTheSun)
{
    const SunRoom room(kFaint);
    const Sun sun{.direction = glm::normalize(SunRoom::kTowardsSun),
                  .irradiance = {3.0f, 2.0f, 1.0f}};
    const AreaLight disc(sunDisc(sun, room.scan));
    const RayScene scene{Scan{}};
    const AreaSample facing = sampleAreaLight(scene, disc, {1, 0, 1}, sun.direction, 16, 0.5f);
    EXPECT_NEAR((facing.visible * sunRadiance(sun)).r, 3.0f, 0.01f);
    const AreaSample floor = sampleAreaLight(scene, disc, {1, 0, 1}, {0, 1, 0}, 16, 0.5f);
    EXPECT_NEAR(floor.visible / facing.visible, sun.direction.y, 0.01f);
}

} // namespace relamp
