#include "base/radiometry.shared.h"
#include "fit/given_lamps.h"
#include "scenes/axes.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::kDown;

/// A lamp of one patch at (1, 2, 3), 0.5 m^2.
FoundLamps onePanel()
{
    FoundLamps found;
    found.lamps.push_back({{{{1, 2, 3}, kDown, 0.5f, 17}},
                           {30, 20, 10},
                           glm::vec3(0.02f),
                           {{.open = 1.0f, .visible = 0.5f}}});
    found.ambient = glm::vec3(0.3f);
    return found;
}

Fixture panelAt(glm::vec3 centre)
{
    return {.centre = centre, .normal = kDown, .area = 0.5f, .radiance = {60, 40, 20}};
}

float areaOf(const FoundLamp& lamp)
{
    float area = 0.0f;
    for (const ClippedPatch& patch : lamp.patches) area += patch.area;
    return area;
}

} // namespace

TEST(GivenLamps, FixtureThatStandsWhereOneWasFoundIsThatOne)
{
    const FoundLamps lamps =
        asGiven({.fixtures = {panelAt({1, 2, 3})}, .ambient = glm::vec3(0.1f)}, onePanel(), {});
    ASSERT_EQ(lamps.lamps.size(), 1u);
    EXPECT_EQ(lamps.lamps[0].patches[0].surfel, 17u);
    EXPECT_EQ(lamps.lamps[0].radiance, glm::vec3(60, 40, 20));
    EXPECT_EQ(lamps.lamps[0].onSides.size(), 1u); // need not be looked at again
    EXPECT_EQ(lamps.ambient, glm::vec3(0.1f));
}

TEST(GivenLamps, LampsOfAGroupStayTogetherAsFarAsTheyAreAlike)
{
    FoundLamps found = onePanel();
    found.lamps[0].patches.push_back({{2, 2, 3}, kDown, 0.5f, 18});
    found.lamps[0].patches.push_back({{3, 2, 3}, kDown, 0.5f, 19});
    found.lamps[0].ends = {1, 2, 3};
    std::vector<Fixture> fixtures{panelAt({1, 2, 3}), panelAt({2, 2, 3}), panelAt({3, 2, 3})};

    const FoundLamps whole = asGiven({.fixtures = fixtures}, found, {});
    ASSERT_EQ(whole.lamps.size(), 1u);
    EXPECT_THAT(whole.lamps[0].ends, testing::ElementsAre(1, 2, 3));
    EXPECT_EQ(whole.lamps[0].onSides.size(), 1u);

    fixtures[1].radiance *= 2.0f;
    const FoundLamps parts = asGiven({.fixtures = fixtures}, found, {});
    ASSERT_EQ(parts.lamps.size(), 2u);
    EXPECT_THAT(parts.lamps[0].ends, testing::ElementsAre(1, 2));
    EXPECT_EQ(parts.lamps[1].patches[0].surfel, 18u);
    EXPECT_THAT(parts.lamps[0].onSides, testing::IsEmpty()); // looked at anew
}

TEST(GivenLamps, WhatIsOffOrNotNamedIsDark)
{
    Fixture off = panelAt({1, 2, 3});
    off.radiance = glm::vec3(0.0f);
    EXPECT_THAT(asGiven({.fixtures = {off}}, onePanel(), {}).lamps, testing::IsEmpty());
    EXPECT_THAT(asGiven({}, onePanel(), {}).lamps, testing::IsEmpty());
}

TEST(GivenLamps, AnyOtherFixtureIsADiscOfItsArea)
{
    const FoundLamps lamps = asGiven({.fixtures = {panelAt({2, 2, 3})}}, onePanel(), {});
    ASSERT_EQ(lamps.lamps.size(), 1u);
    const FoundLamp& disc = lamps.lamps[0];
    EXPECT_NEAR(areaOf(disc), 0.5f, 1e-5f);
    EXPECT_THAT(disc.onSides, testing::IsEmpty());
    const float radius = std::sqrt(0.5f / kPi);
    float squares = 0.0f;
    for (const ClippedPatch& patch : disc.patches) {
        EXPECT_EQ(patch.normal, kDown);
        EXPECT_EQ(patch.surfel, Surfels::kNone);
        EXPECT_NEAR(patch.position.y, 2.0f, 1e-5f);
        EXPECT_LT(glm::distance(patch.position, {2, 2, 3}), radius + 1e-5f);
        const glm::vec3 way = patch.position - glm::vec3(2, 2, 3);
        squares += glm::dot(way, way) / static_cast<float>(disc.patches.size());
    }
    EXPECT_NEAR(squares, 0.5f * radius * radius, 0.06f * radius * radius); // evenly filled
}

// Half a pane hangs off the frame, so that its middle is a hand off; a speck beside it is not
// meant.
TEST(GivenLamps, FixtureOnABurntOutPieceOfAboutItsAreaIsThatPiece)
{
    const std::vector<Candidate> candidates{candidateOf({{{2.1f, 2, 3}, kDown, 0.4f, 21}}),
                                            candidateOf({{{2, 2, 3}, kDown, 0.01f, 22}})};
    const FoundLamps lamps = asGiven({.fixtures = {panelAt({2, 2, 3})}}, onePanel(), candidates);
    ASSERT_EQ(lamps.lamps.size(), 1u);
    ASSERT_EQ(lamps.lamps[0].patches.size(), 1u);
    EXPECT_EQ(lamps.lamps[0].patches[0].surfel, 21u);
    EXPECT_EQ(lamps.lamps[0].radiance, glm::vec3(60, 40, 20));
}

TEST(GivenLamps, FixtureWithoutANormalIsABallOfItsArea)
{
    Fixture bulb = panelAt({2, 2, 3});
    bulb.normal = glm::vec3(0.0f);
    const FoundLamps lamps = asGiven({.fixtures = {bulb}}, onePanel(), {});
    ASSERT_EQ(lamps.lamps.size(), 1u);
    EXPECT_NEAR(areaOf(lamps.lamps[0]), 0.5f, 1e-5f);
    for (const ClippedPatch& patch : lamps.lamps[0].patches)
        EXPECT_NEAR(glm::dot(patch.normal, patch.position - glm::vec3(2, 2, 3)),
                    std::sqrt(0.5f / (4.0f * kPi)), 1e-5f);
}

// Far away a ball of radiance L and radius r is a point of intensity pi r^2 L.
TEST(GivenLamps, PointLightIsABallOfItsIntensity)
{
    const FoundLamps lamps =
        asGiven({.points = {{.position = {0, 0, 0}, .intensity = {4, 2, 1}, .radius = 0.1f}}},
                onePanel(), {});
    ASSERT_EQ(lamps.lamps.size(), 1u);
    float seen = 0.0f; // projected area towards +x
    for (const ClippedPatch& patch : lamps.lamps[0].patches)
        seen += patch.area * std::max(patch.normal.x, 0.0f);
    EXPECT_NEAR(seen * lamps.lamps[0].radiance.r, 4.0f, 0.1f);
}

TEST(GivenLamps, PointLightsOfFixturesAreNotCountedTwice)
{
    const FoundLamps lamps =
        asGiven({.fixtures = {panelAt({1, 2, 3})},
                 .points = {{.position = {1, 2, 3}, .intensity = {4, 2, 1}, .fixture = 0}}},
                onePanel(), {});
    EXPECT_EQ(lamps.lamps.size(), 1u);
}

} // namespace relamp
