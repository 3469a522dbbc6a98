#include "fit/pieces.h"

#include "scenes/axes.h"
#include "scenes/scenes.h"

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::kDown;
using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;

/// A panel of a quarter of a square metre whose left edge is at `x`.
Piece panelAt(float x, float radiance, size_t body)
{
    std::vector<ClippedPatch> patches;
    for (const float step : {0.04f, 0.46f})
        patches.push_back({{x + step, 2.5f, 0.25f}, kDown, 0.125f, 0});
    return {.candidate = candidateOf(std::move(patches)),
            .body = body,
            .direct = LampSight(std::vector<AreaSample>{{0.2f, 0.2f}, {}, {0.1f, 0.1f}, {}}),
            .radiance = glm::vec3(radiance)};
}

Piece patchAt(glm::vec3 place, glm::vec3 normal, float area, size_t body)
{
    return {.candidate = candidateOf({{place, normal, area, 0}}), .body = body};
}

/// Of four patches that face apart.
Piece globeAt(float x, float area, size_t body)
{
    std::vector<ClippedPatch> patches;
    for (const glm::vec3 facing : {kDown, -kDown, glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0)})
        patches.push_back({glm::vec3(x, 2.0f, 0.0f) + 0.05f * facing, facing, 0.25f * area, 0});
    return {.candidate = candidateOf(std::move(patches)), .body = body};
}

/// A panel at 0, its far side above it, and a panel like it at 2.
std::vector<Piece> panelWithFarSideAndAnother()
{
    std::vector<Piece> pieces{panelAt(0, 10, 0), panelAt(0, 10, 0), panelAt(2, 10, 2)};
    pieces[1].isUnseen = true;
    return pieces;
}

/// In a room of nothing else.
Kinship kinOf(const std::vector<Piece>& pieces, const Scan& around = {})
{
    return kinshipOf(pieces, RayScene(around));
}

auto pairOf(uint32_t a, uint32_t b)
{
    return testing::AllOf(Field(&AlikePieces::a, a), Field(&AlikePieces::b, b));
}

} // namespace

TEST(Pieces, ThatTouchAndAreAboutEquallyBrightAreOneLamp)
{
    std::vector<Piece> pieces{panelAt(0, 10, 0), panelAt(0.5f, 20, 1), panelAt(1, 100, 2),
                              panelAt(3, 10, 3)};
    pieces[1].isGiven = true;
    joinPieces(pieces);
    ASSERT_EQ(pieces.size(), 3u); // the third touches, and is too bright; the fourth is far away
    EXPECT_FLOAT_EQ(pieces[0].candidate.area, 0.5f);
    EXPECT_FLOAT_EQ(pieces[0].candidate.centre.x, 0.5f);
    EXPECT_FLOAT_EQ(pieces[0].direct[0].visible, 0.4f);
    EXPECT_TRUE(pieces[0].isGiven);
    EXPECT_FLOAT_EQ(pieces[1].radiance.g, 100.0f);
}

TEST(Pieces, OfOneBodyAreOneLampHoweverBrightTheyCameOut)
{
    std::vector<Piece> pieces = panelWithFarSideAndAnother();
    pieces[1].radiance = glm::vec3(1000.0f);
    joinPieces(pieces);
    ASSERT_EQ(pieces.size(), 2u);
    EXPECT_FALSE(pieces[0].isUnseen);
    EXPECT_FLOAT_EQ(pieces[0].candidate.area, 0.5f);
}

// At a lamp's edge a crumb of it may be fitted to any radiance.
TEST(Pieces, SliverIsOfTheLampThatItTouches)
{
    std::vector<Piece> pieces{panelAt(0, 10, 0), panelAt(2, 10, 1)};
    for (const size_t body : {2u, 3u}) {
        pieces.push_back(panelAt(0.5f, 600, body));
        pieces.back().candidate =
            candidateOf({{{body == 2 ? 0.5f : 1.2f, 2.5f, 0.25f}, kDown, 0.002f, 0}});
    }
    joinPieces(pieces);
    ASSERT_EQ(pieces.size(), 3u); // the second crumb touches nothing
    EXPECT_FLOAT_EQ(pieces[0].candidate.area, 0.252f);
    EXPECT_FLOAT_EQ(pieces[0].radiance.g, 10.0f);
}

TEST(Pieces, GroupsStayAsTheyAre)
{
    std::vector<Piece> pieces{panelAt(0, 10, 0), panelAt(0.5f, 10, 1)};
    pieces[0].ends = {1, 2};
    joinPieces(pieces);
    EXPECT_EQ(pieces.size(), 2u);
}

TEST(Pieces, ThatLookAlikeAreOneModel)
{
    const Kinship kin = kinOf({panelAt(0, 10, 0), panelAt(2, 20, 1), panelAt(4, 10, 2)});
    EXPECT_THAT(kin.alike, ElementsAre(pairOf(0, 1), pairOf(0, 2), pairOf(1, 2)));
    EXPECT_THAT(kin.model, ElementsAre(ElementsAre(1, 2), ElementsAre(0, 2), ElementsAre(0, 1)));
    EXPECT_THAT(kin.leansOn, ElementsAre(IsEmpty(), IsEmpty(), IsEmpty()));
}

TEST(Pieces, OfTwoRoomsAreNoModel)
{
    const scenes::Panel wall{{1.25f, 0, -9}, {0, 0, 18}, {0, 2.5f, 0}};
    const Scan house = scenes::panels(std::span(&wall, 1), 8, scenes::plain(glm::vec3(0.5f)));
    const Kinship kin = kinOf({panelAt(0, 10, 0), panelAt(2, 10, 1), panelAt(4, 10, 2)}, house);
    EXPECT_THAT(kin.alike, ElementsAre(pairOf(1, 2)));
    EXPECT_THAT(kin.model, ElementsAre(IsEmpty(), ElementsAre(2), ElementsAre(1)));
}

// A panel is burnt out in all channels; what it lights on its ceiling is burnt out in red alone.
TEST(Pieces, OfTwoColoursAreNotOneModel)
{
    std::vector<Piece> pieces{panelAt(0, 10, 0), panelAt(2, 10, 1)};
    for (ClippedPatch& patch : pieces[1].candidate.patches) patch.radiance = {1.0f, 0.9f, 0.6f};
    EXPECT_THAT(kinOf(pieces).model, ElementsAre(IsEmpty(), IsEmpty()));
}

// Every crumb is flat and small.
TEST(Pieces, ShapeOfASpeckSaysNothing)
{
    const Kinship kin =
        kinOf({patchAt({0, 2.5f, 0}, kDown, 0.001f, 0), patchAt({2, 2.5f, 0}, kDown, 0.001f, 1)});
    EXPECT_THAT(kin.alike, IsEmpty());
    EXPECT_THAT(kin.model, ElementsAre(IsEmpty(), IsEmpty()));
}

// A wall is burnt out on one side.
TEST(Pieces, GlobesOfOneSizeAreOneModelWhereverTheyHang)
{
    std::vector<Piece> pieces{globeAt(0, 0.16f, 0), globeAt(1, 0.045f, 1), globeAt(2, 0.04f, 2),
                              patchAt({3, 1, 0}, {1, 0, 0}, 0.04f, 3)};
    for (ClippedPatch& patch : pieces[2].candidate.patches) patch.position.y -= 1.0f;
    pieces[2].candidate = candidateOf(pieces[2].candidate.patches);
    const Kinship kin = kinOf(pieces);
    EXPECT_THAT(kin.alike, ElementsAre(pairOf(1, 2))); // the first is more than thrice as large
    EXPECT_THAT(kin.model, ElementsAre(IsEmpty(), ElementsAre(2), ElementsAre(1), IsEmpty()));
}

// It has its near side's radiance, and does not speak for another lamp.
TEST(Pieces, FarSideLeansOnItsNearOneAndIsNoModel)
{
    const Kinship kin = kinOf(panelWithFarSideAndAnother());
    EXPECT_THAT(kin.alike, ElementsAre(pairOf(0, 1), pairOf(0, 2)));
    EXPECT_THAT(kin.model, ElementsAre(ElementsAre(2), IsEmpty(), ElementsAre(0)));
    EXPECT_THAT(kin.leansOn, ElementsAre(IsEmpty(), ElementsAre(0), IsEmpty()));
}

// A window comes in pieces, of which each does what the others do.
TEST(Pieces, PaneLeansOnALargerOneBesideItInOnePlane)
{
    const Piece pane = patchAt({0, 2.5f, 0}, kDown, 0.3f, 0);
    const auto leansOn = [&](glm::vec3 place, glm::vec3 normal) {
        return kinOf({pane, patchAt(place, normal, 0.2f, 1)}).leansOn;
    };
    EXPECT_THAT(leansOn({0.08f, 2.5f, 0}, kDown), ElementsAre(IsEmpty(), ElementsAre(0)));
    EXPECT_THAT(leansOn({1, 2.5f, 0}, kDown), ElementsAre(IsEmpty(), IsEmpty()));     // far away
    EXPECT_THAT(leansOn({0.05f, 2.4f, 0}, kDown), ElementsAre(IsEmpty(), IsEmpty())); // below
    EXPECT_THAT(leansOn({0.08f, 2.5f, 0}, {0.7f, -0.7f, 0}), ElementsAre(IsEmpty(), IsEmpty()));
}

TEST(Pieces, PanesThatLeanDoNotProveEachOther)
{
    const Kinship kin =
        kinOf({patchAt({0, 2.5f, 0}, kDown, 0.3f, 0), patchAt({0.08f, 2.5f, 0}, kDown, 0.3f, 1)});
    EXPECT_THAT(kin.alike, ElementsAre(pairOf(0, 1)));
    EXPECT_THAT(kin.model, ElementsAre(IsEmpty(), IsEmpty()));
    EXPECT_THAT(kin.leansOn, ElementsAre(IsEmpty(), ElementsAre(0)));
}

} // namespace relamp
