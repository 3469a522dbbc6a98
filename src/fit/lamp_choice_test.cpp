#include "fit/lamp_choice.h"

#include "fit/light_fit_test.h"

#include <cmath>
#include <utility>

#include <gmock/gmock.h>

namespace relamp
{

// Of specks there are the more the smaller they are, and of lamps not.
TEST(LampChoice, TheSmallerAPieceIsTheMoreItTakes)
{
    EXPECT_EQ(natsOfSize(0.5f), 0.0);
    EXPECT_EQ(natsOfSize(0.005f), 0.0); // a bulb of 8 cm
    EXPECT_NEAR(natsOfSize(0.0005f), std::log(10.0), 1e-5);
    EXPECT_TRUE(std::isfinite(natsOfSize(0.0f)));
    const std::vector<uint8_t> emits{0, 1};
    const Choosable speck{.natsOfSize = natsOfSize(1e-4f)};
    EXPECT_NEAR(natsToEmit(speck, emits), natsOfLamp() + std::log(50.0), 1e-5);
}

// It shines with what it is a part of, however small it is.
TEST(LampChoice, APartOfALampTakesNextToNothing)
{
    const std::vector<uint8_t> emits{0, 1};
    const Choosable part{.natsOfSize = natsOfSize(1e-4f), .leansOn = {1}};
    EXPECT_LT(natsToEmit(part, emits), 0.1);
    const Choosable alone{.natsOfSize = natsOfSize(1e-4f), .leansOn = {0}};
    EXPECT_GT(natsToEmit(alone, emits), natsOfLamp());
}

namespace
{

/// A bulb, and the shade around it, which lights the same places nearly as the bulb does.
struct BulbInAShade
{
    enum Piece { bulb, shade };

    Floor floor{{{40, 30, 20}, {0, 0, 0}}, 0.02f, 0.0f};
    CameraModel camera;

    explicit BulbInAShade(float unlike = 0.3f)
    {
        for (size_t i = 0; i < floor.model.places(); ++i)
            if (const float ofBulb = floor.model.directAt(i, bulb); ofBulb > 0.0f)
                floor.model.direct[i].push_back(
                    {shade, 0.2f * ofBulb * (i % 4 < 2 ? 1.0f - unlike : 1.0f + unlike)});
        for (const size_t piece : {bulb, shade}) floor.burnOut(piece, 1 - piece, 1.0f);
    }

    /// Which are found from a light where only `first` emits.
    [[nodiscard]] std::vector<uint8_t> chosenFrom(Piece first) const
    {
        std::vector<uint8_t> emits(2, 0);
        emits[first] = 1;
        const LightEstimate start = floor.fit().solve(emits, floor.fit().beginning(), kWide);
        const std::vector<Choosable> pieces(2);
        return chooseLamps({floor.model, floor.pairs, floor.alike, kPairNoise, emits, start.log,
                            camera, TexturePlaces{}},
                           pieces)
            .emits;
    }
};

} // namespace

// Neither taking the shade away nor adding the bulb gains: only the bulb in the shade's place.
TEST(LampChoice, ABulbIsTakenForTheShadeThatItLights)
{
    const BulbInAShade lamp;
    EXPECT_THAT(lamp.chosenFrom(BulbInAShade::bulb), testing::ElementsAre(1, 0));
    EXPECT_THAT(lamp.chosenFrom(BulbInAShade::shade), testing::ElementsAre(1, 0));
}

// A shelf in front of a shade, and a sill below a window, light much of what these light.
TEST(LampChoice, WhatLightsOtherPlacesAsWellIsNotTakenForALamp)
{
    const BulbInAShade lamp(0.6f);
    EXPECT_THAT(lamp.chosenFrom(BulbInAShade::shade), testing::ElementsAre(0, 1));
}

// It is as bright as under a second lamp where the exposure rose, and a gain of that shape takes
// less to believe in than a lamp.
TEST(LampChoice, WhatAGainExplainsTakesNoLamp)
{
    constexpr float kRise = 0.3f; // log
    Floor floor{{{40, 30, 20}, {40, 30, 20}}, 0.02f, 0.0f};
    CameraColumns gain{.known = {0.0}, .expected = {0.0}, .precision = {1.0 / (kRise * kRise)}};
    for (size_t i = 0; i < floor.model.places(); ++i) {
        const glm::vec3 first = floor.restAt(i) + floor.truth[0] * floor.model.directAt(i, 0);
        const glm::vec3 both = first + floor.truth[1] * floor.model.directAt(i, 1);
        const float rise = std::log1p(20.0f * floor.model.directAt(i, 1) / luminance(first));
        floor.model.shown[i] *= first / both * std::exp(rise);
        gain.bend.push_back(-rise / kRise);
    }
    const std::vector<uint8_t> both{1, 1};
    const LightEstimate start = floor.fit().solve(both, floor.fit().beginning(), kWide);
    const CameraModel camera;
    const FittedLight light{floor.model, floor.pairs, floor.alike, kPairNoise,
                            both,        start.log,   camera,      TexturePlaces{}};
    const std::vector<Choosable> pieces(2);
    EXPECT_THAT(chooseLamps(light, pieces).emits, testing::ElementsAre(1, 1));
    EXPECT_THAT(chooseLamps(light, pieces, gain).emits, testing::ElementsAre(1, 0));
}

} // namespace relamp
