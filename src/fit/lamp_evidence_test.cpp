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

/// The room with one panel, and what it tells; a suspect at each of its burnt-out pieces.
struct Told
{
    scenes::Surfaces room{LitRoom().scan};
    HitLists hits = scenes::hitListsOf(room, 64);
    LampEvidence evidence{room.texels, room.rays, hits, room.radiance, Quality::draft};
    std::vector<Candidate> candidates = findCandidates(room.texels, room.radiance);

    [[nodiscard]] std::vector<Suspect> at(glm::vec3 place) const
    {
        return {{.candidate = candidates[nearestTo(candidates, place)]}};
    }
};

} // namespace

// What a wall shows is its albedo times all light that comes to it, over pi.
TEST(LampEvidence, PlacesShowTheLightOfTheirLampsAndWalls)
{
    Told told;
    std::vector<Suspect> panel = told.at(LitRoom::kLampCentre);
    told.evidence.look(panel, 8);
    told.evidence.letShine(panel);
    told.evidence.settle(panel, glm::vec3(0.0f));
    const FitData data = told.evidence.dataOf(panel);
    ASSERT_GT(data.places(), 1000u);
    std::vector<float> albedo;
    for (size_t i = 0; i < data.places(); ++i)
        albedo.push_back(kPi * data.radiance[i].g /
                         (data.gathered[i].g + LitRoom::kLampRadiance.g * data.direct[i]));
    const auto middle = albedo.begin() + static_cast<ptrdiff_t>(albedo.size() / 2);
    std::nth_element(albedo.begin(), middle, albedo.end());
    EXPECT_NEAR(*middle, 0.42f, 0.03f); // most of the room is wall
}

// A lamp's own texels bound no lamp, and send no light as walls.
TEST(LampEvidence, WhatShinesIsNoBurntOutWall)
{
    Told told;
    const FitData walls = told.evidence.dataOf({});
    ASSERT_GT(walls.burntOut, 0u);
    told.evidence.letShine(told.at(LitRoom::kLampCentre));
    const FitData lit = told.evidence.dataOf({});
    EXPECT_LT(lit.burntOut, walls.burntOut);
    EXPECT_GT(lit.burntOut, 0u); // the sheet
    float ofLit = 0.0f;
    float ofWalls = 0.0f;
    for (size_t i = 0; i < lit.places(); ++i) {
        ofLit += lit.gathered[i].g;
        ofWalls += walls.gathered[i].g;
    }
    EXPECT_LT(ofLit, ofWalls);
}

// Two places of a pair lie anywhere, but no pair is of one place, and all are measured ones.
TEST(LampEvidence, PairsAreOfMeasuredPlaces)
{
    Told told;
    told.evidence.drawAllPairs();
    const size_t places = told.evidence.dataOf({}).places();
    for (const size_t perPlace :
         {LampEvidence::kPairsFirst, LampEvidence::kPairsOfTrial, LampEvidence::kPairs}) {
        EXPECT_GT(told.evidence.pairs(perPlace).size(), places);
        for (const MaterialPair pair : told.evidence.pairs(perPlace)) {
            EXPECT_NE(pair.p, pair.q);
            EXPECT_LT(std::max(pair.p, pair.q), places);
        }
    }
}

} // namespace relamp
