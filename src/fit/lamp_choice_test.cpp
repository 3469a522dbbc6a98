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

    BulbInAShade()
    {
        for (size_t i = 0; i < floor.model.places(); ++i)
            if (const float ofBulb = floor.model.directAt(i, bulb); ofBulb > 0.0f)
                floor.model.direct[i].push_back(
                    {shade, 0.2f * ofBulb * (i % 4 < 2 ? 1.0f - kUnlike : 1.0f + kUnlike)});
        for (const size_t piece : {bulb, shade}) floor.burnOut(piece, 1 - piece, 1.0f);
    }

    /// Which are found from a light where only `first` emits.
    [[nodiscard]] std::vector<uint8_t> chosenFrom(Piece first) const
    {
        std::vector<uint8_t> emits(2, 0);
        emits[first] = 1;
        const LightEstimate start = floor.fit().solve(emits, floor.fit().beginning(), kWide);
        const std::vector<Choosable> pieces{{.takenFor = {shade}}, {.takenFor = {bulb}}};
        return chooseLamps({floor.model, floor.pairs, floor.alike, kPairNoise, emits, start.log,
                            camera, TexturePlaces{}},
                           pieces)
            .emits;
    }

    static constexpr float kUnlike = 0.3f;
};

} // namespace

// Neither taking the shade away nor adding the bulb gains: only the bulb in the shade's place.
TEST(LampChoice, ABulbIsTakenForTheShadeThatItLights)
{
    const BulbInAShade lamp;
    EXPECT_THAT(lamp.chosenFrom(BulbInAShade::bulb), testing::ElementsAre(1, 0));
    EXPECT_THAT(lamp.chosenFrom(BulbInAShade::shade), testing::ElementsAre(1, 0));
}

} // namespace relamp
