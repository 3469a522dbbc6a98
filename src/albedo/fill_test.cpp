#include "albedo/fill.h"

#include "albedo/fill.shared.h"
#include "base/radiometry.shared.h"
#include "image/texture_noise.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace relamp
{

constexpr float kEnough = 1.0f; // light: none lacks

/// Surfels in a row, each beside the next.
Surfels row(uint32_t count)
{
    Surfels surfels;
    surfels.position.resize(count);
    surfels.normal.resize(count, glm::vec3(0, 1, 0));
    surfels.firstNeighbor = {0};
    for (uint32_t s = 0; s < count; ++s) {
        surfels.neighbor.push_back(s);
        if (s > 0) surfels.neighbor.push_back(s - 1);
        if (s + 1 < count) surfels.neighbor.push_back(s + 1);
        surfels.firstNeighbor.push_back(static_cast<uint32_t>(surfels.neighbor.size()));
    }
    return surfels;
}

UnknownChannels burntOut(glm::vec3 shares)
{
    return {.burntOut = shares};
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

// A frame that is burnt out, and in its corner a surfel that is part curtain.
TEST(Fill, WhatFacesOtherwiseIsOfAnotherPaint)
{
    Surfels frame = row(4);
    frame.normal[0] = glm::normalize(glm::vec3(2, 1, 0));
    const std::vector<glm::vec3> albedo(4, glm::vec3(0.1f));
    const auto filled = fillFromAround(frame, albedo, std::vector<uint8_t>{1, 0, 0, 0}, 0.7f);
    EXPECT_EQ(filled[0], albedo[0]);
    EXPECT_EQ(filled[1], glm::vec3(0.7f));
}

TEST(Fill, WhatNothingReachesIsGrey)
{
    const std::vector<uint8_t> known(3, 0);
    for (const glm::vec3 rgb : fillFromAround(row(3), std::vector<glm::vec3>(3), known))
        EXPECT_EQ(rgb, glm::vec3(0.5f));
}

TEST(Fill, WhatIsBurntOutIsAsAroundButNeverDarkerThanItShows)
{
    const UnknownChannels all = burntOut(glm::vec3(1.0f));
    const glm::vec3 around(0.8f, 0.7f, 0.6f);
    EXPECT_EQ(filledAlbedo(glm::vec3(0.3f), kEnough, around, all), around);
    const glm::vec3 own(0.86f);
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(filledAlbedo(own, kEnough, around, all), own)));
    EXPECT_EQ(filledAlbedo(glm::vec3(0.3f), kEnough, around, burntOut(glm::vec3(0.0f))),
              glm::vec3(0.3f));
}

TEST(Fill, WhatIsBurntOutIsNoWhiterThanWhitePaint)
{
    EXPECT_EQ(filledAlbedo(glm::vec3(0.95f), kEnough, glm::vec3(0.8f), burntOut(glm::vec3(1.0f))),
              glm::vec3(kWhitePaint));
}

TEST(Fill, ShadingThatNoPaintAgreesWithTellsNothing)
{
    const glm::vec3 around(0.8f, 0.7f, 0.6f);
    EXPECT_EQ(filledAlbedo(glm::vec3(0.9f), 1.8f, around, burntOut(glm::vec3(1.0f))), around);
}

// A red stripe beside a white one, both burnt out in red.
TEST(Fill, ChannelsThatAreWholeSayHowBrightTheOthersAre)
{
    const UnknownChannels red = burntOut({1, 0, 0});
    const glm::vec3 same = filledAlbedo({0.4f, 0.5f, 0.25f}, kEnough, {0.6f, 0.5f, 0.25f}, red);
    EXPECT_NEAR(same.r, 0.6f, 1e-6f);
    EXPECT_EQ(same.g, 0.5f);
    // three times as bright is another paint, of a colour of its own: rather grey
    const glm::vec3 other = filledAlbedo({0.4f, 0.45f, 0.45f}, kEnough, {0.3f, 0.15f, 0.15f}, red);
    EXPECT_GT(other.r, 0.45f);
    EXPECT_LT(other.r, 0.55f);
}

// White cloth beside green: all channels are at white, and under warm light need the least of red.
TEST(Fill, WhatIsBurntOutInAllChannelsHasNoHueOfItsOwn)
{
    const glm::vec3 filled = filledAlbedo({0.66f, 0.75f, 0.83f}, kEnough, {0.3f, 0.45f, 0.2f},
                                          burntOut(glm::vec3(1.0f)));
    EXPECT_GT(filled.r, 0.75f);
    EXPECT_NEAR(filled.g, 0.83f, 0.05f);
    EXPECT_NEAR(filled.b, 0.83f, 0.01f);
}

// A white wall beside a bulb: blue of warm light is the weakest, so a white of blue would need the
// lightest paint.
TEST(Fill, WhatIsBurntOutByWarmLightHasTheHueAround)
{
    const glm::vec3 around(0.6f, 0.58f, 0.55f);
    const glm::vec3 filled =
        filledAlbedo({0.5f, 0.6f, 0.66f}, kEnough, around, burntOut(glm::vec3(1.0f)));
    EXPECT_NEAR(filled.b, 0.66f, 0.01f);
    EXPECT_GT(filled.r, filled.b);
}

// Blended of photos that are burnt out and others that are not.
TEST(Fill, WhatMayBeBurntOutIsFilledInPart)
{
    const glm::vec3 around(0.8f, 0.7f, 0.6f);
    const glm::vec3 half =
        filledAlbedo({0.6f, 0.7f, 0.6f}, kEnough, around, burntOut({0.5f, 0, 0}));
    EXPECT_GT(half.r, 0.65f);
    EXPECT_LT(half.r, 0.7f);
    EXPECT_EQ(half.g, 0.7f);
}

TEST(Fill, WhatIsUnlitIsAsAroundWhateverItShows)
{
    const glm::vec3 around(0.8f, 0.7f, 0.6f);
    const UnknownChannels unlit{.isUnlit = glm::bvec3(true)};
    EXPECT_EQ(filledAlbedo(glm::vec3(0.9f), kEnough, around, unlit), around);
}

TEST(Fill, WhatIsWhiterThanPaperIsRatherAsAround)
{
    const glm::vec3 own(0.5f, 0.6f, 0.9f); // light of another colour
    const glm::vec3 around(0.7f, 0.66f, 0.56f);
    const glm::vec3 none(0.0f);
    EXPECT_EQ(believedUnderLack(own, 1.0f, around, none), own);
    EXPECT_LT(glm::distance(believedUnderLack(own, 100.0f, around, none), around), 0.01f);
    const glm::vec3 half = believedUnderLack(own, 2.0f, around, {0, 0, 1});
    EXPECT_LT(glm::distance(half, glm::vec3(0.6f, 0.63f, 0.9f)), 1e-6f);
    // albedo times light is what it was
    EXPECT_LT(glm::distance(half * lackOfChannels(own, 2.0f, half), 2.0f * own), 1e-5f);
}

// From channels that are whole to channels that are burnt out.
TEST(Fill, ChangesWithoutAStep)
{
    const auto at = [](float red) {
        return filledAlbedo({0.48f, 0.53f, 0.73f}, kEnough, {0.82f, 0.82f, 0.86f},
                            burntOut({red, 1.0f, 1.0f}));
    };
    EXPECT_GT(glm::distance(at(0.0f), at(1.0f)), 0.1f);
    for (int k = 0; k < 1000; ++k)
        EXPECT_LT(
            glm::distance(at(1e-3f * static_cast<float>(k)), at(1e-3f * static_cast<float>(k + 1))),
            3e-3f);
}

// A red cloth in shade: its blue is a byte of 0 or 1.
TEST(Fill, HueOfWhatNoiseHidesIsThatAround)
{
    const glm::vec3 own(0.4f, 0.08f, 0.0f);
    const glm::vec3 around(0.5f, 0.1f, 0.05f);
    const auto filled = [&](float noise) {
        return filledAlbedo(own, kEnough, around,
                            {.hidden = {0.0f, 0.0f, 1.0f}, .noise = glm::vec3(noise)});
    };
    EXPECT_NEAR(filled(0.1f).b, 0.8f * around.b, 0.005f);
    EXPECT_EQ(filled(0.1f).r, own.r);
    EXPECT_EQ(filled(0.01f).b, 0.01f) << "no farther off than noise can make it";
}

TEST(Fill, NoiseHidesNothingOfWhatGetsNoLight)
{
    const TextureNoise noise = textureNoiseOf(Image{}, {});
    const auto hidden = [&](float shading) {
        return hiddenWhereLit(glm::vec3(0.0f), glm::vec3(shading), 0.02f, noise).r;
    };
    EXPECT_LT(hidden(0.0002f), 0.011f);
    EXPECT_NEAR(hidden(0.02f), 1.0f, 1e-3f);
}

TEST(Fill, BlackStaysBlackBesideWhite)
{
    const glm::vec3 black = filledAlbedo(glm::vec3(0.0f), kEnough, glm::vec3(0.8f),
                                         {.hidden = glm::vec3(1.0f), .noise = glm::vec3(0.003f)});
    EXPECT_EQ(black, glm::vec3(0.003f));
}

} // namespace relamp
