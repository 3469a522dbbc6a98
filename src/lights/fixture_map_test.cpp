#include "lights/fixture_map.h"

#include "scenes/scenes.h"
#include "scenes/surfaces.h"

#include <algorithm>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

constexpr int kLeft = 70'000; // more than sixteen bits hold
constexpr int kRight = 3;

/// 2 m squared with two burnt-out stripes of 0.4 m, at whose further ends nobody's begins.
scenes::Surfaces stripes(int pixels)
{
    return scenes::Surfaces(scenes::square(2.0f, pixels, [](glm::vec3 p, glm::vec3) {
        return glm::vec3(p.x < 0.4f || p.x > 1.6f ? 1.0f : 0.3f);
    }));
}

bool isLamp(const ClippedPatch& patch)
{
    return patch.position.z < 1.5f;
}

std::vector<int32_t> fixturesOf(const scenes::Surfaces& floor)
{
    std::vector<int32_t> fixtureOf(floor.texels.surfels.count(), FixtureMap::kWall);
    for (const ClippedPatch& patch : floor.radiance.clipped)
        if (isLamp(patch)) fixtureOf[patch.surfel] = patch.position.x < 1.0f ? kLeft : kRight;
    return fixtureOf;
}

float areaOf(const std::vector<ClippedPatch>& patches)
{
    float area = 0.0f;
    for (const ClippedPatch& patch : patches) area += patch.area;
    return area;
}

} // namespace

TEST(FixtureMap, SurfacesComeBackPatchByPatch)
{
    const scenes::Surfaces floor = stripes(200);
    const FixtureMap map = fixtureMapOf(floor.texels, 0, fixturesOf(floor));
    const SurfacesOfFixtures surfaces = surfacesBy({&map, 1}, floor.texels, floor.radiance);
    ASSERT_EQ(surfaces.size(), 2u);
    std::vector<uint32_t> expected;
    for (const ClippedPatch& patch : floor.radiance.clipped)
        if (isLamp(patch) && patch.position.x < 1.0f) expected.push_back(patch.surfel);
    std::vector<uint32_t> found;
    for (const ClippedPatch& patch : surfaces.at(kLeft)) found.push_back(patch.surfel);
    EXPECT_EQ(found, expected);
    EXPECT_FALSE(surfaces.at(kRight).empty());
}

TEST(FixtureMap, TellsTheTexelsOfALampFromABurntOutWallAndTheRest)
{
    const scenes::Surfaces floor = stripes(200);
    const FixtureMap map = fixtureMapOf(floor.texels, 0, fixturesOf(floor));
    const auto count = [&](int32_t id) { return std::count(map.id.begin(), map.id.end(), id); };
    EXPECT_EQ(count(FixtureMap::kNone), 200 * 120);
    EXPECT_GT(count(FixtureMap::kWall), 200 * 10);
    EXPECT_EQ(count(kLeft) + count(kRight) + count(FixtureMap::kWall), 200 * 80);
}

// A draft has a smaller texture than the result whose map it takes, and the other way round.
TEST(FixtureMap, IsLookedUpByTexturesOfOtherSizes)
{
    const scenes::Surfaces large = stripes(200);
    const FixtureMap map = fixtureMapOf(large.texels, 0, fixturesOf(large));
    const SurfacesOfFixtures own = surfacesBy({&map, 1}, large.texels, large.radiance);
    for (const int pixels : {64, 400}) {
        const scenes::Surfaces other = stripes(pixels);
        const SurfacesOfFixtures found = surfacesBy({&map, 1}, other.texels, other.radiance);
        ASSERT_EQ(found.size(), 2u) << pixels;
        for (const auto& [id, patches] : found)
            EXPECT_NEAR(areaOf(patches), areaOf(own.at(id)), 0.1f * areaOf(own.at(id))) << pixels;
    }
}

// The texture of a result is its albedo, which shows no lamp.
TEST(FixtureMap, TellsWhatIsBurntOutOfATextureThatIsNoPhoto)
{
    const scenes::Surfaces photo = stripes(200);
    const FixtureMap map = fixtureMapOf(photo.texels, 0, fixturesOf(photo));
    const scenes::Surfaces paint(scenes::square(2.0f, 200, scenes::plain(glm::vec3(0.5f))));
    Progress progress;
    const SurfelRadiance radiance = collectRadiance(paint.texels, progress, burntOutBy({&map, 1}));
    EXPECT_EQ(radiance.isClipped, photo.radiance.isClipped);
    EXPECT_EQ(radiance.clippedArea, photo.radiance.clippedArea);
}

} // namespace relamp
