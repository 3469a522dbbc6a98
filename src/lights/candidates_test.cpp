#include "lights/candidates.h"

#include "scenes/scenes.h"
#include "scenes/surfaces.h"

#include <cmath>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

std::vector<Candidate> candidatesOf(Scan scan)
{
    const scenes::Surfaces surfaces(std::move(scan));
    return findCandidates(surfaces.texels, surfaces.radiance);
}

/// A square floor of radiance `around` with a white disc of `radius` in its middle.
scenes::Paint discIn(float side, float radius, float around)
{
    return [=](glm::vec3 p, glm::vec3) {
        const bool isIn = glm::distance(p, glm::vec3(0.5f * side, 0.0f, 0.5f * side)) < radius;
        return glm::vec3(isIn ? 1.0f : around);
    };
}

/// A box as bright as `brightness(place)` over a grey floor.
template<class Brightness>
Scan boxOver(float side, const Brightness& brightness)
{
    std::vector<scenes::Panel> parts{{{0, 0, 0}, {0, 0, 2}, {2, 0, 0}}};
    for (scenes::Panel wall : scenes::wallsOf(glm::vec3(side))) {
        std::swap(wall.alongU, wall.alongV); // its outer sides
        wall.corner += glm::vec3(1.0f, 0.5f, 1.0f);
        parts.push_back(wall);
    }
    return scenes::panels(parts, 64, [&](glm::vec3 p, glm::vec3) {
        return glm::vec3(p.y > 0.4f ? brightness(p) : 0.3f);
    });
}

} // namespace

// A panel at the edge of the ceiling and the wall that it burns out touch, around a corner.
TEST(Candidates, PanelAndTheWallBesideItAreTwo)
{
    const auto candidates =
        candidatesOf(scenes::room({4.0f, 2.5f, 5.0f}, 64, [](glm::vec3 p, glm::vec3 n) {
            const bool isPanel = n.y < -0.5f && p.x < 0.6f && std::abs(p.z - 2.5f) < 0.5f;
            const bool isBurnt = n.x > 0.5f && p.y > 1.5f && std::abs(p.z - 2.5f) < 1.0f;
            return glm::vec3(isPanel || isBurnt ? 1.0f : 0.4f);
        }));
    ASSERT_EQ(candidates.size(), 2u);
    EXPECT_NEAR(candidates[0].area, 2.0f, 0.1f); // the largest first
    EXPECT_NEAR(candidates[0].normal.x, 1.0f, 0.01f);
    EXPECT_NEAR(candidates[1].area, 0.6f, 0.05f);
    EXPECT_NEAR(candidates[1].normal.y, -1.0f, 0.01f);
    EXPECT_NEAR(candidates[1].centre.x, 0.3f, 0.03f);
}

// A flat dome on a ceiling that it burns out is one blob without an edge; it stands off the plane.
TEST(Candidates, LampIsCutOffThePlaneThatItRisesOver)
{
    const std::vector<scenes::Panel> parts{
        {{0, 0, 0}, {0, 0, 2}, {2, 0, 0}},                 // the plane, facing up
        {{0.6f, 0, 0.7f}, {0, 0, 0.6f}, {0.3f, 0.15f, 0}}, // a ramp up, 27 degrees
        {{0.9f, 0.15f, 0.7f}, {0, 0, 0.6f}, {0.3f, 0, 0}}, // its top
        {{1.2f, 0.15f, 0.7f}, {0, 0, 0.6f}, {0.3f, -0.15f, 0}}};
    const auto candidates = candidatesOf(scenes::panels(parts, 64, scenes::plain(glm::vec3(1.0f))));
    ASSERT_EQ(candidates.size(), 2u);
    EXPECT_NEAR(candidates[0].area, 4.0f, 0.2f);
    EXPECT_NEAR(candidates[0].centre.y, 0.0f, 0.01f);
    EXPECT_NEAR(candidates[1].area, 0.58f, 0.15f);
    EXPECT_NEAR(candidates[1].centre.y, 0.1f, 0.03f);
}

// A panel stands five centimetres off the ceiling that it burns out on both sides of it, and the
// scan joins them by ramps with a ledge. The ledges' plane, half way, would hold all of them.
TEST(Candidates, PanelIsCutOffTheCeilingThatItHardlyRisesOver)
{
    const auto strip = [](glm::vec2 from, glm::vec2 to) { // x and y
        return scenes::Panel{
            {from.x, from.y, 0.7f}, {0, 0, 0.6f}, {to.x - from.x, to.y - from.y, 0}};
    };
    const std::vector<scenes::Panel> parts{
        {{0, 0, 0}, {0, 0, 2}, {2, 0, 0}}, // ceiling, facing up
        strip({0.55f, 0}, {0.62f, 0.025f}),     strip({0.62f, 0.025f}, {0.68f, 0.025f}),
        strip({0.68f, 0.025f}, {0.75f, 0.05f}), strip({0.75f, 0.05f}, {1.25f, 0.05f}), // the panel
        strip({1.25f, 0.05f}, {1.32f, 0.025f}), strip({1.32f, 0.025f}, {1.38f, 0.025f}),
        strip({1.38f, 0.025f}, {1.45f, 0})};
    const scenes::Paint paint = [](glm::vec3 p, glm::vec3) {
        const float off = std::abs(p.x - 1.0f);
        const bool isPool = off > 0.45f && off < 0.75f && std::abs(p.z - 1.0f) < 0.3f;
        return glm::vec3(isPool || p.y > 0.001f ? 1.0f : 0.5f);
    };
    const auto candidates = candidatesOf(scenes::panels(parts, 64, paint));
    ASSERT_EQ(candidates.size(), 3u);
    EXPECT_NEAR(candidates[0].centre.y, 0.05f, 0.01f);
    EXPECT_NEAR(candidates[0].area, 0.37f, 0.06f); // with the upper ramps
    for (const size_t pool : {1u, 2u}) {
        EXPECT_NEAR(candidates[pool].centre.y, 0.0f, 0.01f);
        EXPECT_NEAR(candidates[pool].area, 0.27f, 0.06f); // with a ramp and a ledge
    }
}

// A sconce's pool of light is small for a plane, but the wall goes on around it; a lamp's own flat
// side ends where the lamp does.
TEST(Candidates, LampIsCutOffTheSmallPoolOnTheWallBehindIt)
{
    const std::vector<scenes::Panel> parts{
        {{0, 0, 0}, {0, 0, 2}, {2, 0, 0}},                 // the wall, facing up
        {{0.9f, 0, 0.9f}, {0, 0, 0.2f}, {0.1f, 0.08f, 0}}, // one side of the sconce
        {{1.0f, 0.08f, 0.9f}, {0, 0, 0.2f}, {0.1f, -0.08f, 0}}};
    const scenes::Paint pool = [](glm::vec3 p, glm::vec3) {
        const bool isIn = glm::distance(p, glm::vec3(1.0f, 0.0f, 1.0f)) < 0.3f;
        return glm::vec3(isIn ? 1.0f : 0.5f);
    };
    const auto candidates = candidatesOf(scenes::panels(parts, 64, pool));
    ASSERT_GE(candidates.size(), 2u);
    EXPECT_NEAR(candidates[0].area, 0.28f, 0.05f);
    EXPECT_NEAR(candidates[0].centre.y, 0.0f, 0.02f);
    EXPECT_GT(candidates[1].centre.y, 0.03f);
}

// A speck that only just burnt out in a bright wall lights nothing; a bulb is as small, in the
// dark.
TEST(Candidates, SpecksInBrightWallsAreNoneAndBulbsAre)
{
    EXPECT_TRUE(candidatesOf(scenes::square(2.0f, 200, discIn(2.0f, 0.06f, 0.8f))).empty());
    const auto bulbs = candidatesOf(scenes::square(2.0f, 200, discIn(2.0f, 0.06f, 0.2f)));
    ASSERT_EQ(bulbs.size(), 1u);
    EXPECT_NEAR(bulbs[0].area, 0.0113f, 0.001f);
}

// A bulb of a few surfels is a box to them, as small as crumbs; a shade is one as well.
TEST(Candidates, BulbIsOneAndSoIsABox)
{
    for (const float side : {0.06f, 0.5f}) {
        const auto candidates = candidatesOf(boxOver(side, [](glm::vec3) { return 1.0f; }));
        ASSERT_EQ(candidates.size(), 1u);
        EXPECT_NEAR(candidates[0].area, 6 * side * side, 0.1f * side * side);
        EXPECT_LT(glm::length(candidates[0].normal), 0.1f);
    }
}

/// The sides of a cone's stump of `sides` quads from `low` to `high` metres, and its two ends.
std::vector<scenes::Panel> stump(int sides, float turn, float low, float high)
{
    const auto at = [&](int i, float height, float radius) {
        const float angle = turn + 6.2831853f * static_cast<float>(i) / static_cast<float>(sides);
        return glm::vec3(radius * std::cos(angle), height, radius * std::sin(angle));
    };
    std::vector<scenes::Panel> panels;
    for (int i = 0; i < sides; ++i) {
        const glm::vec3 corner = at(i, low, 0.2f);
        panels.push_back({corner, at(i, high, 0.18f) - corner, at(i + 1, low, 0.2f) - corner});
    }
    panels.push_back({{-0.1f, high, -0.1f}, {0, 0, 0.2f}, {0.2f, 0, 0}});
    panels.push_back({{-0.1f, low, -0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f}});
    return panels;
}

// A round shade has no edge between its sides but at its ends, and is cut anywhere by the surfels'
// facings.
TEST(Candidates, RoundShadeIsOneWithItsEndsHoweverItIsTurned)
{
    for (const float turn : {0.0f, 0.3f, 0.7f}) {
        const auto candidates = candidatesOf(
            scenes::panels(stump(24, turn, 0.5f, 0.8f), 256, scenes::plain(glm::vec3(1.0f))));
        ASSERT_EQ(candidates.size(), 1u) << turn;
        EXPECT_NEAR(candidates[0].area, 0.43f, 0.04f);
    }
}

// The inside of a shade looks at its bulb; both are burnt out.
TEST(Candidates, BulbIsNotOneWithTheCeilingOfItsShade)
{
    std::vector<scenes::Panel> parts{{{-0.03f, 0.09f, -0.03f}, {0.06f, 0, 0}, {0, 0, 0.06f}}};
    for (scenes::Panel wall : scenes::wallsOf(glm::vec3(0.06f))) {
        std::swap(wall.alongU, wall.alongV); // its outer sides
        wall.corner -= glm::vec3(0.03f, 0.0f, 0.03f);
        parts.push_back(wall);
    }
    const auto candidates = candidatesOf(scenes::panels(parts, 64, scenes::plain(glm::vec3(1.0f))));
    ASSERT_EQ(candidates.size(), 2u);
    EXPECT_NEAR(candidates[0].area, 6 * 0.06f * 0.06f, 0.002f);
}

// What faces each other is no body, nor is what stands back to back: two rooms share a wall.
TEST(Candidates, WallsOfARoomAreSixAndSidesOfAWallAreTwo)
{
    const scenes::Paint white = scenes::plain(glm::vec3(1.0f));
    EXPECT_EQ(candidatesOf(scenes::room({3.0f, 2.0f, 2.5f}, 64, white)).size(), 6u);
    const std::vector<scenes::Panel> wall{{{0, 0, 0}, {0, 0, 2}, {0, 2, 0}},
                                          {{0.1f, 0, 0}, {0, 2, 0}, {0, 0, 2}}};
    const auto candidates = candidatesOf(scenes::panels(wall, 64, white));
    ASSERT_EQ(candidates.size(), 2u);
    EXPECT_LT(glm::dot(candidates[0].normal, candidates[1].normal), -0.9f);
}

// A photograph's noise leaves texels of a bulb just below white: every crumb between them lies in
// what is nearly as bright, as a speck in a wall does, and all together are a bulb.
TEST(Candidates, BulbThatIsBurntOutInCrumbsIsOne)
{
    const auto candidates = candidatesOf(boxOver(0.06f, [](glm::vec3 p) {
        const glm::vec3 cell = glm::floor(p / 0.012f);
        return std::fmod(cell.x + cell.y + cell.z, 2.0f) < 0.5f ? 1.0f : 0.93f;
    }));
    ASSERT_EQ(candidates.size(), 1u);
    EXPECT_NEAR(candidates[0].area, 3 * 0.06f * 0.06f, 0.5f * 0.06f * 0.06f);
}

TEST(Candidates, FixtureOverASeamIsOne)
{
    const auto candidates = candidatesOf(scenes::splitSquare(2.0f, 128, discIn(2.0f, 0.4f, 0.3f)));
    ASSERT_EQ(candidates.size(), 1u);
    EXPECT_NEAR(candidates[0].area, 0.503f, 0.02f);
    EXPECT_NEAR(candidates[0].centre.x, 1.0f, 0.02f);
}

TEST(Candidates, LargestComesFirst)
{
    const scenes::Paint stripes = [](glm::vec3 p, glm::vec3) {
        const bool isIn = (p.x > 0.2f && p.x < 0.8f) || (p.x > 1.4f && p.x < 1.7f);
        return glm::vec3(isIn && p.z > 0.5f && p.z < 1.5f ? 1.0f : 0.3f);
    };
    const auto candidates = candidatesOf(scenes::square(2.0f, 128, stripes));
    ASSERT_EQ(candidates.size(), 2u);
    EXPECT_NEAR(candidates[0].area, 0.6f, 0.03f);
    EXPECT_NEAR(candidates[1].area, 0.3f, 0.03f);
}

// A wall's overexposure fades into what is not yet burnt out; a lamp ends where it ends.
TEST(Candidates, WallsFadeAndLampsEnd)
{
    const auto isFading = [](const scenes::Paint& paint) {
        const scenes::Surfaces surfaces(scenes::square(2.0f, 200, paint));
        const auto candidates = findCandidates(surfaces.texels, surfaces.radiance);
        EXPECT_EQ(candidates.size(), 1u);
        return fades(surfaces.texels, surfaces.radiance, candidates.at(0));
    };
    EXPECT_TRUE(isFading([](glm::vec3 p, glm::vec3) {
        const float far = glm::distance(p, glm::vec3(1.0f, 0.0f, 1.0f));
        return glm::vec3(std::min(1.0f, 1.3f - far), 0.5f, 0.3f);
    }));
    EXPECT_FALSE(isFading(discIn(2.0f, 0.3f, 0.6f)));
}

} // namespace relamp
