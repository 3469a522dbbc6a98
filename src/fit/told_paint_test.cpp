#include "fit/told_paint.h"

#include "fit/lamps.h"
#include "fit/light_fit_test.h"
#include "scenes/lit_room.h"
#include "scenes/surfaces.h"

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::LitRoom;

/// A floor whose paint ends where the light of its lamp does: places of even number lie in that
/// light, and their paint is twice as bright as the other. Pairs do not know. Behind these come
/// places of one paint in light and in shade.
struct MisleadingFloor
{
    static constexpr uint32_t kPlaces = 400;
    static constexpr size_t kTold = 8;    // pairs of places that are of one paint
    static constexpr float kLamp = 10.0f; // radiance

    LightModel model{.pieces = 1};
    std::vector<MaterialPair> pairs;

    explicit MisleadingFloor(float inShade = 0.25f)
    {
        Numbers random;
        for (size_t i = 0; i < kPlaces; ++i) addPlace(i % 2 == 0, i % 2 == 0 ? 0.5f : inShade);
        for (size_t i = 0; i < 8 * kPlaces; ++i) {
            const auto p = static_cast<uint32_t>(random.between(0, kPlaces));
            pairs.push_back({p, static_cast<uint32_t>(random.between(0, kPlaces))});
        }
        for (size_t i = 0; i < 2 * kTold; ++i) addPlace(i % 2 == 0, 0.4f);
        addPieces(model);
    }

    void addPlace(bool isLit, float albedo)
    {
        constexpr float kGathered = 0.5f;
        constexpr float kLit = 0.1f;
        model.gathered.emplace_back(kGathered);
        model.missed.emplace_back();
        const float direct = isLit ? kLit : 0.0f;
        model.direct.push_back({{0, direct}});
        model.shown.emplace_back(albedo / kPi * (kGathered + kLamp * direct));
    }

    /// Log albedo of what is lit less that of what is in shade, of one paint, when so many of such
    /// pairs are told.
    [[nodiscard]] double albedoStep(size_t told) const
    {
        std::vector<MaterialPair> same;
        for (uint32_t k = 0; k < told; ++k) same.push_back({kPlaces + 2 * k, kPlaces + 2 * k + 1});
        LightFit fit(model, pairs, {}, kPairNoise);
        fit.believe(same);
        const std::vector<uint8_t> emits{1};
        const std::vector<double> log = fit.logAlbedo(fit.solve(emits, fit.beginning(), kWide), {});
        return log[kPlaces] - log[kPlaces + 1];
    }
};

GatherOptions told(std::vector<SamePaint> same, std::vector<glm::vec3> white)
{
    return {.same = std::move(same), .white = std::move(white)};
}

} // namespace

// All pairs across the edge are of two paints, and make the lamp twice as strong as it is. One word
// is no match for 75 pairs that all are wrong alike, but a few are.
TEST(ToldPaint, PeopleAreBelievedWhereAllPairsAreWrong)
{
    const MisleadingFloor floor;
    const double misled = floor.albedoStep(0);
    EXPECT_NEAR(misled, -std::log(2.0), 0.15);
    EXPECT_LT(std::abs(floor.albedoStep(1)), std::abs(misled));
    EXPECT_NEAR(floor.albedoStep(MisleadingFloor::kTold), 0.0, 0.2);
}

// Of 16 pairs, half across the edge and half not: all tell the same light.
TEST(ToldPaint, WhatIsRightAlreadyStays)
{
    const MisleadingFloor floor(0.5f);
    EXPECT_NEAR(floor.albedoStep(0), 0.0, 0.05);
    EXPECT_NEAR(floor.albedoStep(MisleadingFloor::kTold), 0.0, 0.02);
}

TEST(ToldPaint, SurfacesNearestToThePlacesAreMeant)
{
    const scenes::Surfaces room(LitRoom().scan);
    std::vector<std::string> warnings;
    const glm::vec3 onFloor{3.1f, 0.02f, 1.2f};
    const glm::vec3 onWall{3.98f, 1.0f, 4.1f};
    const ToldPaint paint = toldPaintOf(told({{onFloor, onWall}}, {onWall}), room.texels.surfels,
                                        room.radiance, warnings);
    ASSERT_EQ(paint.same.size(), 1u);
    ASSERT_EQ(paint.white.size(), 1u);
    const Surfels& surfels = room.texels.surfels;
    EXPECT_GT(surfels.normal[paint.same[0].p].y, 0.99f);
    EXPECT_LT(surfels.normal[paint.same[0].q].x, -0.99f);
    EXPECT_EQ(paint.white[0], paint.same[0].q);
    EXPECT_THAT(warnings, testing::IsEmpty());
}

TEST(ToldPaint, WhatShowsNoPaintIsNamedAndPassedOver)
{
    const scenes::Surfaces room(LitRoom().scan);
    std::vector<std::string> warnings;
    const ToldPaint paint = toldPaintOf(told({{{9, 1, 1}, {3, 0, 1}}}, {LitRoom::kSheetCentre}),
                                        room.texels.surfels, room.radiance, warnings);
    EXPECT_THAT(paint.same, testing::IsEmpty());
    EXPECT_THAT(paint.white, testing::IsEmpty());
    EXPECT_THAT(warnings, testing::ElementsAre(
                              testing::HasSubstr("no surface is within 30 cm of 9, 1, 1"),
                              testing::HasSubstr("burnt out at 0, 1.4, 2.5 and shows no paint")));
}

} // namespace relamp
