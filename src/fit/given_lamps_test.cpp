#include "base/radiometry.shared.h"
#include "fit/given_lamps.h"
#include "scenes/axes.h"
#include "scenes/scenes.h"
#include "scenes/surfaces.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::kDown;

/// One patch at a place, 0.5 m^2 of surfel 17.
std::vector<ClippedPatch> panelSurface(glm::vec3 centre)
{
    return {{centre, kDown, 0.5f, 17}};
}

Fixture panelAt(glm::vec3 centre, int id = -1)
{
    return {.centre = centre, .normal = kDown, .area = 0.5f, .radiance = {60, 40, 20}, .id = id};
}

float areaOf(std::span<const ClippedPatch> patches)
{
    float area = 0.0f;
    for (const ClippedPatch& patch : patches) area += patch.area;
    return area;
}

/// Surfaces of fixtures in a room that does not matter.
struct Found
{
    std::vector<std::vector<ClippedPatch>> surfaces;
    std::vector<std::string> notes;
};

Found surfacesAmong(const std::vector<Fixture>& fixtures, const KnownSurfaces& known)
{
    const scenes::Surfaces room(scenes::room({4, 3, 4}, 16, scenes::plain(glm::vec3(0.5f))));
    Found found;
    found.surfaces = surfacesOf(fixtures, known, room.texels, room.rays, found.notes);
    return found;
}

/// What asGiven makes of fixtures of which nothing is known but what they say.
FoundLamps lampsOf(const Lights& given)
{
    return asGiven(given, surfacesAmong(given.fixtures, {}).surfaces);
}

} // namespace

// Another lamp is nearer, and the list is in any order.
TEST(GivenLamps, ANumberIsALampWhateverStandsNearAndInAnyOrder)
{
    KnownSurfaces known;
    known.byNumber[8] = panelSurface({1, 2, 3});
    known.byNumber[2] = panelSurface({1.1f, 2, 3});
    const Found found = surfacesAmong({panelAt({1.09f, 2, 3}, 8), panelAt({1.1f, 2, 3}, 2)}, known);
    EXPECT_EQ(found.surfaces[0][0].position.x, 1.0f);
    EXPECT_EQ(found.surfaces[1][0].position.x, 1.1f);
    EXPECT_THAT(found.notes, testing::IsEmpty());
}

TEST(GivenLamps, NothingBurntOutIsLookedAtWhereNumbersDo)
{
    KnownSurfaces known;
    known.byNumber[8] = panelSurface({1, 2, 3});
    known.burntOut = []() -> std::vector<Candidate> {
        ADD_FAILURE();
        return {};
    };
    surfacesAmong({panelAt({1, 2, 3}, 8)}, known);
}

// As in a lights.json of relamp 0.1.
TEST(GivenLamps, AFixtureWithoutANumberIsKnownByItsPlaceAndANoteSaysSo)
{
    KnownSurfaces known;
    known.byNumber[8] = panelSurface({1, 2, 3});
    const Found found = surfacesAmong({panelAt({1.01f, 2, 3}), panelAt({3, 2, 3})}, known);
    EXPECT_EQ(found.surfaces[0][0].surfel, 17u);
    EXPECT_EQ(found.surfaces[1][0].surfel, Surfels::kNone);
    ASSERT_THAT(found.notes, testing::SizeIs(1));
    EXPECT_THAT(found.notes[0], testing::AllOf(testing::HasSubstr("no \"id\""),
                                               testing::HasSubstr("1 by what is burnt out")));
}

TEST(GivenLamps, AFixtureThatWasMovedShinesWhereItIsNow)
{
    KnownSurfaces known;
    known.byNumber[8] = panelSurface({1, 2, 3});
    const Found found = surfacesAmong({panelAt({3, 2, 3}, 8)}, known);
    EXPECT_EQ(found.surfaces[0][0].surfel, Surfels::kNone);
    EXPECT_NEAR(found.surfaces[0][0].position.x, 3.0f, 0.5f);
    EXPECT_THAT(found.notes, testing::ElementsAre(testing::HasSubstr("was moved")));
}

TEST(GivenLamps, RadianceAndAmbientAreTheFiles)
{
    const FoundLamps lamps =
        lampsOf({.fixtures = {panelAt({1, 2, 3}, 5)}, .ambient = glm::vec3(0.1f)});
    ASSERT_EQ(lamps.lamps.size(), 1u);
    EXPECT_EQ(lamps.powers.lamps[0], glm::vec3(60, 40, 20));
    EXPECT_EQ(lamps.lamps[0].labels.at(0).id, 5);
    EXPECT_EQ(lamps.powers.outside[0], glm::vec3(0.1f));
}

TEST(GivenLamps, LampsOfAGroupStayTogetherAsFarAsTheyAreAlike)
{
    std::vector<Fixture> fixtures{panelAt({1, 2, 3}, 4), panelAt({2, 2, 3}, 1),
                                  panelAt({3, 2, 3}, 6)};
    for (Fixture& fixture : fixtures) fixture.group = 4;
    const FoundLamps whole = lampsOf({.fixtures = fixtures});
    ASSERT_EQ(whole.lamps.size(), 1u);
    EXPECT_EQ(singlesOf(whole.lamps[0]).size(), 3u);
    EXPECT_EQ(whole.lamps[0].labels.size(), 3u);
    EXPECT_EQ(whole.lamps[0].labels[1].id, 1);

    fixtures[1].radiance *= 2.0f;
    const FoundLamps parts = lampsOf({.fixtures = fixtures});
    ASSERT_EQ(parts.lamps.size(), 2u);
    EXPECT_EQ(singlesOf(parts.lamps[0]).size(), 2u);
    EXPECT_EQ(parts.lamps[1].labels.at(0).id, 1);
}

TEST(GivenLamps, WhatIsOffOrNotNamedIsDark)
{
    Fixture off = panelAt({1, 2, 3});
    off.radiance = glm::vec3(0.0f);
    EXPECT_THAT(lampsOf({.fixtures = {off}}).lamps, testing::IsEmpty());
    EXPECT_THAT(lampsOf({}).lamps, testing::IsEmpty());
}

TEST(GivenLamps, AnyOtherFixtureIsADiscOfItsArea)
{
    const std::vector<ClippedPatch> disc = bodyOf(panelAt({2, 2, 3}));
    EXPECT_NEAR(areaOf(disc), 0.5f, 1e-5f);
    const float radius = std::sqrt(0.5f / kPi);
    float squares = 0.0f;
    for (const ClippedPatch& patch : disc) {
        EXPECT_EQ(patch.normal, kDown);
        EXPECT_EQ(patch.surfel, Surfels::kNone);
        EXPECT_NEAR(patch.position.y, 2.0f, 1e-5f);
        EXPECT_LT(glm::distance(patch.position, {2, 2, 3}), radius + 1e-5f);
        const glm::vec3 way = patch.position - glm::vec3(2, 2, 3);
        squares += glm::dot(way, way) / static_cast<float>(disc.size());
    }
    EXPECT_NEAR(squares, 0.5f * radius * radius, 0.06f * radius * radius); // evenly filled
}

// Half a pane hangs off the frame, so that its middle is a hand off; a speck beside it is not
// meant.
TEST(GivenLamps, FixtureOnABurntOutPieceOfAboutItsAreaIsThatPiece)
{
    const std::vector<Candidate> candidates{candidateOf({{{2.1f, 2, 3}, kDown, 0.4f, 21}}),
                                            candidateOf({{{1.95f, 2, 3}, kDown, 0.01f, 22}})};
    const Found found = surfacesAmong({panelAt({2, 2, 3})},
                                      {.byNumber = {}, .burntOut = [&] { return candidates; }});
    ASSERT_EQ(found.surfaces[0].size(), 1u);
    EXPECT_EQ(found.surfaces[0][0].surfel, 21u);
}

TEST(GivenLamps, FixtureWithoutANormalIsABallOfItsArea)
{
    Fixture bulb = panelAt({2, 2, 3});
    bulb.normal = glm::vec3(0.0f);
    const std::vector<ClippedPatch> ball = bodyOf(bulb);
    EXPECT_NEAR(areaOf(ball), 0.5f, 1e-5f);
    for (const ClippedPatch& patch : ball)
        EXPECT_NEAR(glm::dot(patch.normal, patch.position - glm::vec3(2, 2, 3)),
                    std::sqrt(0.5f / (4.0f * kPi)), 1e-5f);
}

// Far away a ball of radiance L and radius r is a point of intensity pi r^2 L.
TEST(GivenLamps, PointLightIsABallOfItsIntensity)
{
    const FoundLamps lamps =
        lampsOf({.points = {{.position = {0, 0, 0}, .intensity = {4, 2, 1}, .radius = 0.1f}}});
    ASSERT_EQ(lamps.lamps.size(), 1u);
    float seen = 0.0f; // projected area towards +x
    for (const ClippedPatch& patch : lamps.lamps[0].patches)
        seen += patch.area * std::max(patch.normal.x, 0.0f);
    EXPECT_NEAR(seen * lamps.powers.lamps[0].r, 4.0f, 0.1f);
}

TEST(GivenLamps, PointLightsOfFixturesAreNotCountedTwice)
{
    const FoundLamps lamps =
        lampsOf({.fixtures = {panelAt({1, 2, 3})},
                 .points = {{.position = {1, 2, 3}, .intensity = {4, 2, 1}, .fixture = 0}}});
    EXPECT_EQ(lamps.lamps.size(), 1u);
}

} // namespace relamp
