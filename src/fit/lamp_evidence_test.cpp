#include "fit/lamp_evidence.h"

#include "base/radiometry.shared.h"
#include "scenes/lit_room.h"
#include "scenes/surfaces.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::LitRoom;

/// The room with one panel, and what it tells; a piece at each place that burns out.
struct Told
{
    scenes::Surfaces room{LitRoom().scan};
    HitLists hits = scenes::hitListsOf(room, 64);
    LampEvidence evidence{room.texels, room.rays, hits, room.radiance, Quality::draft};
    std::vector<Candidate> candidates = findCandidates(room.texels, room.radiance);

    [[nodiscard]] std::vector<Piece> at(std::initializer_list<glm::vec3> places) const
    {
        std::vector<Piece> pieces;
        for (const glm::vec3 place : places)
            pieces.push_back(
                {.candidate = candidates[nearestTo(candidates, place)], .body = pieces.size()});
        evidence.look(pieces, 8);
        return pieces;
    }

    LightModel modelOf(std::span<const Piece> pieces)
    {
        return evidence.modelOf(pieces, evidence.sightsOf(pieces));
    }
};

} // namespace

// What a wall shows is its albedo times all light that comes to it, over pi.
TEST(LampEvidence, PlacesShowTheLightOfTheirLampsAndWalls)
{
    Told told;
    std::vector<Piece> panel = told.at({LitRoom::kLampCentre});
    panel[0].radiance = LitRoom::kLampRadiance;
    told.evidence.settle(panel, glm::vec3(0.0f));
    const LightModel model = told.modelOf(panel);
    ASSERT_GT(model.places(), 1000u);
    std::vector<float> albedo;
    for (size_t i = 0; i < model.places(); ++i)
        albedo.push_back(kPi * model.shown[i].g /
                         (model.gathered[i].g + LitRoom::kLampRadiance.g * model.directAt(i, 0)));
    const auto middle = albedo.begin() + static_cast<ptrdiff_t>(albedo.size() / 2);
    std::nth_element(albedo.begin(), middle, albedo.end());
    EXPECT_NEAR(*middle, 0.42f, 0.03f); // most of the room is wall
}

// The light of a piece comes from it alone, emits it or reflects.
TEST(LampEvidence, PiecesSendNoLightAsWalls)
{
    Told told;
    const LightModel walls = told.modelOf({});
    const LightModel lit = told.modelOf(told.at({LitRoom::kLampCentre}));
    ASSERT_EQ(lit.places(), walls.places());
    float ofLit = 0.0f;
    float ofWalls = 0.0f;
    for (size_t i = 0; i < lit.places(); ++i) {
        EXPECT_LE(lit.gathered[i].g, walls.gathered[i].g * 1.0001f);
        ofLit += lit.gathered[i].g;
        ofWalls += walls.gathered[i].g;
    }
    EXPECT_LT(ofLit, ofWalls);
}

// Behind the places comes what lights the pieces: the panel lights the sheet, and by that the sheet
// burns out; neither lights itself.
TEST(LampEvidence, PiecesLightEachOtherAndNotThemselves)
{
    Told told;
    const LightModel model = told.modelOf(told.at({LitRoom::kLampCentre, LitRoom::kSheetCentre}));
    const auto panel = told.candidates[nearestTo(told.candidates, LitRoom::kLampCentre)];
    const AreaSample light =
        sampleAreaLight(told.room.rays, AreaLight(panel.patches), LitRoom::kSheetCentre,
                        glm::vec3(1.0f, 0.0f, 0.0f), 1024, 0.5f);
    EXPECT_NEAR(model.directAt(model.placeOf(1), 0) / light.visible, 1.0f, 0.2f);
    EXPECT_GT(model.directAt(model.placeOf(0), 1), 0.0f);
    for (size_t f = 0; f < 2; ++f) {
        EXPECT_EQ(model.directAt(model.placeOf(f), f), 0.0f);
        EXPECT_GT(model.gathered[model.placeOf(f)].g, 0.0f);
        EXPECT_GT(model.shown[model.placeOf(f)].r, 0.97f); // burnt out
    }
    EXPECT_NEAR(model.area[0], LitRoom::kLampArea, 0.1f * LitRoom::kLampArea);
}

// Of a far side nothing is seen: no light on it is known.
TEST(LampEvidence, PieceOfNoSurfelHasNoArea)
{
    Told told;
    std::vector<Piece> panel = told.at({LitRoom::kLampCentre});
    for (ClippedPatch& patch : panel[0].candidate.patches) patch.surfel = Surfels::kNone;
    const LightModel model = told.modelOf(panel);
    EXPECT_EQ(model.area[0], 0.0f);
}

// Two places of a pair lie anywhere, but no pair is of one place, and all are measured ones.
TEST(LampEvidence, PairsAreOfMeasuredPlaces)
{
    Told told;
    told.evidence.drawAllPairs();
    const size_t places = told.modelOf(told.at({LitRoom::kLampCentre})).places();
    for (const size_t perPlace : {LampEvidence::kPairsFirst, LampEvidence::kPairs}) {
        EXPECT_GT(told.evidence.pairs(perPlace).size(), places / 2);
        for (const MaterialPair pair : told.evidence.pairs(perPlace)) {
            EXPECT_NE(pair.p, pair.q);
            EXPECT_LT(std::max(pair.p, pair.q), places);
        }
    }
}

} // namespace relamp
