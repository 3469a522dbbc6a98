#include "fit/lamp_choice.h"

#include <cmath>

#include <gtest/gtest.h>

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

} // namespace relamp
