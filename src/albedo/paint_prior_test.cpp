#include "albedo/paint_prior.h"

#include "albedo/paint_prior.shared.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr glm::vec3 kWallPaint(0.4f);
constexpr glm::vec3 kNoneBurntOut(0.0f); // no channel is burnt out
constexpr glm::vec3 kWellLitPlace(1.0f); // shading
constexpr float kNoDarker = 0.005f;

/// Of what is right to within 15 % with this probability: docs/method/reliability.md.
float varianceWhereRight(float probability)
{
    const float square = probability * probability;
    return 0.5f * 0.15f * 0.15f * (1.0f - square) / square;
}

glm::vec3 drawn(glm::vec3 own, glm::vec3 around, float trust, glm::vec3 burntOut = kNoneBurntOut,
                glm::vec3 shading = kWellLitPlace)
{
    return drawnToPaint(own, around, varianceWhereRight(trust), burntOut, shading, kNoDarker);
}

/// Grey surfels in a row, of which the middle one shows something else.
struct Row
{
    static constexpr uint32_t kCount = 9;
    static constexpr uint32_t kMiddle = kCount / 2;

    Surfels surfels;
    std::vector<glm::vec3> albedo = std::vector<glm::vec3>(kCount, kWallPaint);
    std::vector<uint8_t> isKnown = std::vector<uint8_t>(kCount, 1);
    std::vector<float> variance = std::vector<float>(kCount, 0.0f);

    Row(glm::vec3 middle, float trustInIt)
    {
        surfels.size = 1.0f;
        surfels.firstNeighbor = {0};
        for (uint32_t s = 0; s < kCount; ++s) {
            surfels.position.emplace_back(static_cast<float>(s), 0.0f, 0.0f);
            surfels.normal.emplace_back(0.0f, 1.0f, 0.0f);
            for (uint32_t n = s > 0 ? s - 1 : 0; n <= std::min(s + 1, kCount - 1); ++n)
                surfels.neighbor.push_back(n);
            surfels.firstNeighbor.push_back(static_cast<uint32_t>(surfels.neighbor.size()));
        }
        albedo[kMiddle] = middle;
        variance[kMiddle] = varianceWhereRight(trustInIt);
    }

    [[nodiscard]] glm::vec3 middle() const
    {
        return paintAround(surfels, albedo, isKnown, variance)[kMiddle];
    }
};

} // namespace

TEST(PaintPrior, WhatIsSureStaysAsItIs)
{
    const glm::vec3 dark(0.1f);
    EXPECT_EQ(Row(dark, 1.0f).middle(), dark);
    EXPECT_EQ(drawn(dark, kWallPaint, 1.0f), dark);
}

TEST(PaintPrior, WhatIsInDoubtIsOfThePaintAround)
{
    const glm::vec3 leaked(0.15f); // light that leaks in makes paint dark
    EXPECT_GT(Row(leaked, 0.1f).middle().g, 0.35f);
    EXPECT_GT(drawn(leaked, kWallPaint, 0.1f).g, 0.25f);
    EXPECT_LT(drawn(leaked, kWallPaint, 0.1f).g, kWallPaint.g);
}

TEST(PaintPrior, IsTheLessTheSurerTheLight)
{
    const glm::vec3 leaked(0.15f);
    float before = kWallPaint.g;
    for (const float trust : {0.05f, 0.2f, 0.5f, 0.8f, 0.95f}) {
        const float after = drawn(leaked, kWallPaint, trust).g;
        EXPECT_LT(after, before);
        EXPECT_GT(after, leaked.g);
        before = after;
    }
    EXPECT_NEAR(before, leaked.g, 0.02f * leaked.g);
}

// A poster on a wall keeps its red, however little is known of the light there.
TEST(PaintPrior, AnotherHueIsAnotherPaint)
{
    const glm::vec3 red(0.6f, 0.08f, 0.05f);
    EXPECT_LT(glm::distance(Row(red, 0.1f).middle(), red), 0.05f);
    EXPECT_LT(glm::distance(drawn(red, kWallPaint, 0.1f), red), 0.05f);
}

TEST(PaintPrior, AStepOfBrightnessInGoodLightIsAnotherPaint)
{
    const glm::vec3 black(0.05f);
    EXPECT_NEAR(Row(black, 0.8f).middle().g, black.g, 0.1f * black.g);
    EXPECT_NEAR(drawn(black, kWallPaint, 0.8f).g, black.g, 0.1f * black.g);
}

TEST(PaintPrior, WhatIsNotKnownTellsNothing)
{
    const glm::vec3 dark(0.15f);
    Row row(dark, 0.1f);
    row.isKnown.assign(Row::kCount, 0);
    row.isKnown[Row::kMiddle] = 1;
    EXPECT_LT(glm::distance(row.middle(), dark), 1e-6f);
    row.isKnown.assign(Row::kCount, 1);
    row.isKnown[Row::kMiddle] = 0; // filled before, by what it could
    EXPECT_EQ(row.middle(), dark);
}

TEST(PaintPrior, UnlitAndBurntOutChannelsStayForOthers)
{
    const glm::vec3 own(0.2f);
    EXPECT_EQ(drawn(own, kWallPaint, 0.1f, kNoneBurntOut, glm::vec3(0.0f)), own);
    const glm::vec3 part = drawn(own, kWallPaint, 0.1f, {1.0f, 0.0f, 0.0f});
    EXPECT_EQ(part.r, own.r);
    EXPECT_GT(part.g, 0.3f);
}

} // namespace relamp
