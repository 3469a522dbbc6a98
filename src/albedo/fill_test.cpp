#include "albedo/fill.h"

#include "albedo/fill.shared.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>

namespace relamp
{

constexpr float kEnough = 1.0f; // light: none lacks

/// Surfels in a row, each beside the next.
Surfels row(uint32_t count)
{
    Surfels surfels;
    surfels.position.resize(count);
    surfels.firstNeighbor = {0};
    for (uint32_t s = 0; s < count; ++s) {
        surfels.neighbor.push_back(s);
        if (s > 0) surfels.neighbor.push_back(s - 1);
        if (s + 1 < count) surfels.neighbor.push_back(s + 1);
        surfels.firstNeighbor.push_back(static_cast<uint32_t>(surfels.neighbor.size()));
    }
    return surfels;
}

TEST(Fill, CarriesTheRimInwardsAndKeepsWhatIsKnown)
{
    const std::vector<glm::vec3> albedo(7, glm::vec3(0.2f, 0.4f, 0.6f));
    const std::vector<uint8_t> known{1, 0, 0, 0, 0, 0, 1};
    for (const glm::vec3 rgb : fillFromAround(row(7), albedo, known))
        EXPECT_LT(glm::distance(rgb, albedo[0]), 1e-6f);
}

TEST(Fill, ValuesMeetInTheMiddle)
{
    std::vector<glm::vec3> albedo(5, glm::vec3(0.0f));
    albedo[4] = glm::vec3(1.0f);
    const std::vector<uint8_t> known{1, 0, 0, 0, 1};
    const auto filled = fillFromAround(row(5), albedo, known);
    EXPECT_FLOAT_EQ(filled[2].g, 0.5f);
    EXPECT_LE(filled[1].g, filled[3].g);
}

TEST(Fill, WhatNothingReachesIsGrey)
{
    const std::vector<uint8_t> known(3, 0);
    for (const glm::vec3 rgb : fillFromAround(row(3), std::vector<glm::vec3>(3), known))
        EXPECT_EQ(rgb, glm::vec3(0.5f));
}

TEST(Fill, WhatIsBurntOutIsAsAroundButNeverDarkerThanItShows)
{
    const glm::vec3 all(1.0f);
    const glm::bvec3 none(false);
    const glm::vec3 around(0.8f, 0.7f, 0.6f);
    EXPECT_EQ(filledAlbedo(glm::vec3(0.3f), kEnough, around, all, none), around);
    EXPECT_EQ(filledAlbedo(glm::vec3(0.9f), kEnough, around, all, none), glm::vec3(0.9f));
    EXPECT_EQ(filledAlbedo(glm::vec3(0.3f), kEnough, around, glm::vec3(0.0f), none),
              glm::vec3(0.3f));
}

TEST(Fill, ShadingThatNoPaintAgreesWithTellsNothing)
{
    const glm::vec3 around(0.8f, 0.7f, 0.6f);
    EXPECT_EQ(filledAlbedo(glm::vec3(0.9f), 1.8f, around, glm::vec3(1.0f), glm::bvec3(false)),
              around);
}

// A red stripe beside a white one, both burnt out in red.
TEST(Fill, ChannelsThatAreWholeSayHowBrightTheOthersAre)
{
    const glm::vec3 red(1, 0, 0);
    const glm::bvec3 none(false);
    const glm::vec3 same =
        filledAlbedo({0.4f, 0.5f, 0.25f}, kEnough, {0.6f, 0.5f, 0.25f}, red, none);
    EXPECT_NEAR(same.r, 0.6f, 1e-6f);
    EXPECT_EQ(same.g, 0.5f);
    // three times as bright is another paint, of a colour of its own: rather grey
    const glm::vec3 other =
        filledAlbedo({0.4f, 0.45f, 0.45f}, kEnough, {0.3f, 0.15f, 0.15f}, red, none);
    EXPECT_GT(other.r, 0.45f);
    EXPECT_LT(other.r, 0.55f);
}

// White cloth beside green: all channels are at white, and under warm light need the least of red.
TEST(Fill, WhatIsBurntOutInAllChannelsHasNoHueOfItsOwn)
{
    const glm::vec3 filled = filledAlbedo({0.7f, 0.8f, 0.88f}, kEnough, {0.3f, 0.45f, 0.2f},
                                          glm::vec3(1.0f), glm::bvec3(false));
    EXPECT_GT(filled.r, 0.8f);
    EXPECT_NEAR(filled.g, 0.88f, 0.05f);
    EXPECT_NEAR(filled.b, 0.88f, 0.01f);
}

// Blended of photos that are burnt out and others that are not.
TEST(Fill, WhatMayBeBurntOutIsFilledInPart)
{
    const glm::vec3 around(0.8f, 0.7f, 0.6f);
    const glm::vec3 half =
        filledAlbedo({0.6f, 0.7f, 0.6f}, kEnough, around, {0.5f, 0, 0}, glm::bvec3(false));
    EXPECT_GT(half.r, 0.65f);
    EXPECT_LT(half.r, 0.7f);
    EXPECT_EQ(half.g, 0.7f);
}

TEST(Fill, WhatIsUnlitIsAsAroundWhateverItShows)
{
    const glm::vec3 around(0.8f, 0.7f, 0.6f);
    EXPECT_EQ(filledAlbedo(glm::vec3(0.9f), kEnough, around, glm::vec3(0.0f), glm::bvec3(true)),
              around);
}

// From channels that are whole to channels that are burnt out.
TEST(Fill, ChangesWithoutAStep)
{
    const auto at = [](float burntOut) {
        return filledAlbedo({0.48f, 0.53f, 0.73f}, kEnough, {0.82f, 0.82f, 0.86f},
                            glm::vec3(burntOut, 1.0f, 1.0f), glm::bvec3(false));
    };
    EXPECT_GT(glm::distance(at(0.0f), at(1.0f)), 0.1f);
    for (int k = 0; k < 1000; ++k)
        EXPECT_LT(
            glm::distance(at(1e-3f * static_cast<float>(k)), at(1e-3f * static_cast<float>(k + 1))),
            3e-3f);
}

} // namespace relamp
