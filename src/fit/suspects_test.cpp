#include "fit/suspects.h"

#include "scenes/axes.h"

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::kDown;
using testing::ElementsAre;

/// A panel of a quarter of a square metre whose left edge is at `x`.
Suspect suspectAt(float x, float radiance, size_t body)
{
    std::vector<ClippedPatch> patches;
    for (const float step : {0.05f, 0.45f})
        patches.push_back({{x + step, 2.5f, 0.25f}, kDown, 0.125f, 0});
    return {.candidate = candidateOf(std::move(patches)),
            .direct = {0.2f, 0.0f, 0.1f, 0.0f},
            .radiance = glm::vec3(radiance),
            .body = body};
}

Suspect spotAt(float x, float area, float radiance, size_t body)
{
    return {.candidate = candidateOf({{{x, 2.5f, 0.0f}, kDown, area, 0}}),
            .radiance = glm::vec3(radiance),
            .body = body};
}

/// Of four patches that face apart.
Suspect globeAt(float x, float area, float radiance, size_t body)
{
    std::vector<ClippedPatch> patches;
    for (const glm::vec3 facing : {kDown, -kDown, glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0)})
        patches.push_back({glm::vec3(x, 2.0f, 0.0f) + 0.05f * facing, facing, 0.25f * area, 0});
    return {.candidate = candidateOf(std::move(patches)),
            .radiance = glm::vec3(radiance),
            .body = body};
}

} // namespace

TEST(Suspects, ReachIsTheShareOfPlacesThatSeeThem)
{
    EXPECT_FLOAT_EQ(suspectAt(0, 10, 0).reach(), 0.5f);
    EXPECT_FLOAT_EQ(Suspect{}.reach(), 0.0f);
}

// Two places: one gets a quarter of its light from the first lamp, the other gets only bounces.
// What is burnt out is not measured.
TEST(Suspects, SharesAreOfTheLightAtMeasuredPlaces)
{
    std::vector<Suspect> suspects{suspectAt(0, 10, 0), suspectAt(2, 20, 1)};
    const FitData data{.lamps = 2,
                       .burntOut = 1,
                       .radiance = {glm::vec3(0.2f), glm::vec3(0.2f), glm::vec3(1.0f)},
                       .gathered = {glm::vec3(0.5f), glm::vec3(1.0f), glm::vec3(1.0f)},
                       .missed = {0.5f, 0.0f, 0.0f},
                       .direct = {0.05f, 0.025f, 0.0f, 0.0f, 1.0f, 1.0f}};
    findShares(data, glm::vec3(1.0f), suspects);
    EXPECT_NEAR(suspects[0].share, 0.125f, 1e-5f);
    EXPECT_NEAR(suspects[1].share, 0.125f, 1e-5f);
}

TEST(Suspects, FarSidesGoWithTheirLamps)
{
    std::vector<Suspect> suspects{suspectAt(0, 10, 0), suspectAt(2, 20, 1), suspectAt(2, 20, 1)};
    suspects[2].isUnseen = true;
    EXPECT_THAT(goneWith(suspects, 0), ElementsAre(1, 0, 0));
    EXPECT_THAT(goneWith(suspects, 1), ElementsAre(0, 1, 1));
    EXPECT_THAT(goneWith(suspects, 2), ElementsAre(0, 0, 1)); // it may go alone
    suspects.erase(suspects.begin() + 1);
    EXPECT_EQ(dropHalves(suspects), 1u);
    ASSERT_EQ(suspects.size(), 1u);
    EXPECT_EQ(suspects[0].body, 0u);
}

TEST(Suspects, PiecesThatTouchAndAreAboutEquallyBrightAreOneLamp)
{
    std::vector<Suspect> suspects{suspectAt(0, 10, 0), suspectAt(0.5f, 20, 1), suspectAt(1, 100, 2),
                                  suspectAt(3, 10, 3)};
    suspects[1].isGiven = true;
    joinPieces(suspects);
    ASSERT_EQ(suspects.size(), 3u); // the third touches, and is too bright; the fourth is far away
    EXPECT_FLOAT_EQ(suspects[0].candidate.area, 0.5f);
    EXPECT_FLOAT_EQ(suspects[0].candidate.centre.x, 0.5f);
    EXPECT_FLOAT_EQ(suspects[0].direct[0], 0.4f);
    EXPECT_TRUE(suspects[0].isGiven);
    EXPECT_FLOAT_EQ(suspects[1].radiance.g, 100.0f);
}

// At a lamp's edge a crumb of it may be fitted to any radiance.
TEST(Suspects, SliverIsOfTheLampThatItTouches)
{
    std::vector<Suspect> suspects{suspectAt(0, 10, 0), suspectAt(2, 10, 1)};
    for (const size_t body : {2u, 3u}) {
        suspects.push_back(suspectAt(0.5f, 600, body));
        suspects.back().candidate =
            candidateOf({{{body == 2 ? 0.5f : 1.2f, 2.5f, 0.25f}, kDown, 0.002f, 0}});
    }
    joinPieces(suspects);
    ASSERT_EQ(suspects.size(), 3u); // the second crumb touches nothing
    EXPECT_FLOAT_EQ(suspects[0].candidate.area, 0.252f);
    EXPECT_FLOAT_EQ(suspects[0].radiance.g, 10.0f);
}

TEST(Suspects, OfOneModelArePairsThatLookAlike)
{
    const std::vector<Suspect> suspects{suspectAt(0, 10, 0), suspectAt(2, 20, 1),
                                        suspectAt(4, 10, 2)};
    EXPECT_EQ(alikesOf(suspects).size(), 3u);
}

// Of a spot the scan shows half, of another all: the half was found twice as bright.
TEST(Suspects, SpecksThatAreEquallyPowerfulAreOneModel)
{
    const std::vector<Suspect> suspects{spotAt(0, 0.001f, 800, 0), spotAt(2, 0.002f, 400, 1),
                                        spotAt(4, 0.002f, 4000, 2)};
    const std::vector<AlikeLamps> alike = alikesOf(suspects);
    ASSERT_EQ(alike.size(), 1u); // the third is ten times as powerful
    EXPECT_EQ(alike[0].a, 0u);
    EXPECT_EQ(alike[0].b, 1u);
    EXPECT_FLOAT_EQ(alike[0].ratio, 2.0f);
}

TEST(Suspects, FourSpotsThatAgreeAreAFamilyAndThreeAreNot)
{
    std::vector<Suspect> suspects{spotAt(0, 0.001f, 800, 0), spotAt(2, 0.002f, 400, 1),
                                  spotAt(4, 0.002f, 4000, 2), spotAt(6, 0.001f, 700, 3),
                                  spotAt(8, 0.002f, 300, 4)};
    EXPECT_THAT(familyOf(suspects, 0), ElementsAre(0, 1, 3, 4));
    EXPECT_THAT(familyOf(suspects, 2), ElementsAre(2));
    suspects.pop_back();
    EXPECT_THAT(familyOf(suspects, 0), ElementsAre(0));
}

TEST(Suspects, WallsAndPanelsAreNoFamilies)
{
    std::vector<Suspect> walls;
    std::vector<Suspect> panels;
    for (size_t i = 0; i < 6; ++i) {
        walls.push_back(spotAt(2.0f * static_cast<float>(i), 0.002f, 1, i));
        panels.push_back(suspectAt(2.0f * static_cast<float>(i), 10, i));
    }
    EXPECT_THAT(familyOf(walls, 0), ElementsAre(0));
    EXPECT_THAT(familyOf(panels, 3), ElementsAre(3)); // each speaks for itself
}

// A window comes in pieces, of which each does what the others do.
TEST(Suspects, PanesTouchInOnePlaneAndAreEquallyBright)
{
    const Suspect pane = suspectAt(0, 10, 0);
    EXPECT_TRUE(arePanesOfOne(pane, suspectAt(0.5f, 12, 1)));
    EXPECT_FALSE(arePanesOfOne(pane, suspectAt(0.5f, 20, 1))); // too bright
    EXPECT_FALSE(arePanesOfOne(pane, suspectAt(3, 12, 1)));    // far away
    Suspect below = suspectAt(0.5f, 12, 1);
    below.candidate = candidateOf({{{0.5f, 2.4f, 0.25f}, kDown, 0.25f, 0}});
    EXPECT_FALSE(arePanesOfOne(pane, below));
    below.candidate = candidateOf({{{0.5f, 2.5f, 0.25f}, {0.7f, -0.7f, 0}, 0.25f, 0}});
    EXPECT_FALSE(arePanesOfOne(pane, below));
}

// A globe between two others is missed little, for they do what it does; a wall is no globe.
TEST(Suspects, TwoGlobesOfOneSizeAreAFamilyAndOneModel)
{
    const std::vector<Suspect> suspects{globeAt(0, 0.04f, 80, 0), globeAt(1, 0.045f, 75, 1),
                                        globeAt(2, 0.08f, 40, 2), globeAt(3, 0.04f, 5, 3)};
    EXPECT_THAT(familyOf(suspects, 1), ElementsAre(0, 1)); // the last is much weaker
    EXPECT_THAT(familyOf(suspects, 2), ElementsAre(2));    // twice as large
    const std::vector<AlikeLamps> alike = alikesOf(suspects);
    ASSERT_EQ(alike.size(), 3u); // all but the large one, whatever they were fitted to
    for (const AlikeLamps& pair : alike) EXPECT_FLOAT_EQ(pair.ratio, 1.0f);
}

} // namespace relamp
