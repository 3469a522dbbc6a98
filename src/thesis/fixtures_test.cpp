#include "thesis/fixtures.h"

#include "base/radiometry.shared.h"
#include "scenes/scenes.h"
#include "thesis/expand.shared.h"

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

constexpr glm::vec3 kRoom(4.0f, 2.5f, 5.0f);

bool isInSquare(glm::vec3 p, glm::vec3 centre, float half)
{
    return std::abs(p.x - centre.x) < half && std::abs(p.z - centre.z) < half;
}

/// A grey room with a burnt-out square of 0.5 m in the ceiling and one of 1 m in the floor.
scenes::Paint twoPanels()
{
    return [](glm::vec3 p, glm::vec3 n) {
        const bool ceiling = n.y < -0.5f && isInSquare(p, {1.0f, 0.0f, 1.0f}, 0.25f);
        const bool floor = n.y > 0.5f && isInSquare(p, {3.0f, 0.0f, 4.0f}, 0.5f);
        return glm::vec3(ceiling || floor ? 1.0f : 0.4f);
    };
}

struct Found
{
    SurfelLight light;
    std::vector<Fixture> fixtures;
};

Found find(const Scan& scan, const EmitterOptions& options = {})
{
    Progress progress;
    const Texels texels = rasterizeAtlas(scan, progress);
    Found found{collectLight(texels, options, progress), {}};
    const int count = joinFixtures(found.light, texels, options);
    found.fixtures = fixturesFrom(found.light.emitters, count);
    return found;
}

} // namespace

TEST(Fixtures, AreTheConnectedBurntOutPieces)
{
    const Scan scan = scenes::room(kRoom, 128, twoPanels());
    const auto fixtures = find(scan).fixtures;
    ASSERT_EQ(fixtures.size(), 2u);
    EXPECT_NEAR(fixtures[0].area, 1.0f, 0.05f); // the stronger comes first
    EXPECT_NEAR(fixtures[1].area, 0.25f, 0.03f);
    EXPECT_LT(glm::distance(fixtures[0].centre, glm::vec3(3.0f, 0.0f, 4.0f)), 0.03f);
    EXPECT_LT(glm::distance(fixtures[1].centre, glm::vec3(1.0f, 2.5f, 1.0f)), 0.03f);
    EXPECT_GT(fixtures[0].normal.y, 0.99f);
    EXPECT_LT(fixtures[1].normal.y, -0.99f);
}

TEST(Fixtures, LeaveTheLightOfOtherSurfacesToTheSurfels)
{
    const Scan scan = scenes::room(kRoom, 128, twoPanels());
    const SurfelLight light = find(scan).light;
    for (size_t s = 0; s < light.radiance.size(); ++s)
        if (light.area[s] > 0.0f) {
            EXPECT_NEAR(light.radiance[s].g, 0.4f, 1e-3f);
        }
}

TEST(Fixtures, DropBlobsTooWeakToLightARoom)
{
    const Scan scan = scenes::room(kRoom, 128, twoPanels());
    EXPECT_EQ(find(scan, {.leastPower = 0.5f}).fixtures.size(), 1u);
}

// A patch of radiance L and area A sends pi L A; spread over the sphere that is L A / 4 a
// steradian.
TEST(Fixtures, PointLightsSendThePowerOfThePatchesThatTheyStandFor)
{
    const Scan scan = scenes::room(kRoom, 128, twoPanels());
    const EmitterOptions options{.expansion = 8.0f};
    const Found found = find(scan, options);
    const auto lights = pointLightsFrom(found.light.emitters, 5);
    EXPECT_GE(lights.size(), 32u);
    float sum = 0.0f;
    for (const PointLight& light : lights) sum += light.intensity.g;
    EXPECT_NEAR(sum, 8.0f * 1.25f / 4.0f, 0.1f);
    float power = 0.0f;
    for (const Fixture& fixture : found.fixtures) power += fixture.power().g;
    EXPECT_NEAR(4.0f * kPi * sum, power, 1e-3f * power);
}

// So that a fixture can be switched off with what shines for it.
TEST(Fixtures, EveryPointLightIsOfTheFixtureThatItsRegionHasMostOf)
{
    const Scan scan = scenes::room(kRoom, 128, twoPanels());
    const Found found = find(scan);
    for (const PointLight& light : pointLightsFrom(found.light.emitters, 5)) {
        ASSERT_GE(light.fixture, 0);
        const Fixture& own = found.fixtures.at(static_cast<size_t>(light.fixture));
        for (const Fixture& other : found.fixtures)
            EXPECT_LE(glm::distance(light.position, own.centre),
                      glm::distance(light.position, other.centre) + 1e-4f);
    }
}

TEST(Fixtures, MergingKeepsPowerAndTheSidesThatLightsFace)
{
    const std::vector<PointLight> lights{
        {.position = {0.0f, 2.0f, 0.0f}, .normal = {0, -1, 0}, .intensity = glm::vec3(1.0f)},
        {.position = {0.2f, 2.0f, 0.0f}, .normal = {0, -1, 0}, .intensity = glm::vec3(3.0f)},
        {.position = {0.1f, 2.0f, 0.0f}, .normal = {0, 1, 0}, .intensity = glm::vec3(2.0f)},
        {.position = {3.0f, 2.0f, 0.0f}, .normal = {0, -1, 0}, .intensity = glm::vec3(1.0f)},
    };
    const auto merged = mergeLights(lights, 0.5f);
    ASSERT_EQ(merged.size(), 3u);
    EXPECT_NEAR(merged[0].intensity.g, 4.0f, 1e-6f);
    EXPECT_NEAR(merged[0].position.x, 0.15f, 1e-6f); // weighted by power
    EXPECT_GT(merged[1].normal.y, 0.99f);
    EXPECT_EQ(mergeLights(lights, 0.0f).size(), 4u);
}

TEST(Expand, LeavesTheDarkAndTakesWhiteToThePeak)
{
    EXPECT_NEAR(expanded(glm::vec3(1.0f), 8.0f).g, 8.0f, 1e-5f);
    EXPECT_NEAR(expanded(glm::vec3(0.01f), 8.0f).g, 0.01f, 1e-4f);
    const glm::vec3 warm = expanded({0.9f, 0.6f, 0.3f}, 8.0f);
    EXPECT_NEAR(warm.r / warm.b, 3.0f, 1e-5f);
}

} // namespace relamp
