#include "fit/reliability.h"

#include "base/radiometry.shared.h"
#include "scenes/scenes.h"
#include "scenes/surfaces.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

/// Even light, with this spread, on all surfels.
SurfelLighting evenLight(const scenes::Surfaces& room, float spread = 0.0f)
{
    const size_t count = room.texels.surfels.count();
    return {std::vector<glm::vec3>(count, glm::vec3(1.0f)), std::vector<float>(count, spread)};
}

std::vector<LightVariance> varianceIn(const scenes::Surfaces& room, float spread = 0.0f)
{
    return varianceOf(scenes::hitListsOf(room, 64), evenLight(room, spread));
}

float probability(const SurfelTrust& trust)
{
    return trust.seen * trust.front * trust.edges;
}

scenes::Surfaces greyRoom()
{
    return scenes::Surfaces(scenes::room({2, 2, 2}, 32, scenes::plain(glm::vec3(0.4f))));
}

} // namespace

TEST(Reliability, LightOfARoomSeenFromInsideIsRight)
{
    for (const SurfelTrust& trust : reliabilityOf(varianceIn(greyRoom()), {})) {
        EXPECT_GT(probability(trust), 0.95f);
        EXPECT_LT(probability(trust), 1.0f);
    }
}

TEST(Reliability, FloorUnderTheSkyIsLitByWhatIsNotInTheScan)
{
    const scenes::Surfaces floor(scenes::square(1.0f, 32, scenes::plain(glm::vec3(0.4f))));
    for (const SurfelTrust& trust : reliabilityOf(varianceIn(floor), {})) {
        EXPECT_LT(trust.seen, 0.75f);
        EXPECT_EQ(trust.front, 1.0f);
        EXPECT_GT(trust.edges, 0.95f);
    }
}

// A sheet close above the floor that faces up, too, shows it its back.
TEST(Reliability, FloorUnderASheetSeesItsBack)
{
    const scenes::Panel floor{{1, 0, 1}, {0, 0, 1}, {1, 0, 0}};
    const scenes::Panel sheet{{0, 0.1f, 0}, {0, 0, 3}, {3, 0, 0}};
    const scenes::Panel both[] = {floor, sheet};
    const scenes::Surfaces room(scenes::panels(both, 64, scenes::plain(glm::vec3(0.4f))));
    const auto trust = reliabilityOf(varianceIn(room), {});
    EXPECT_LT(trust[room.at({1.5f, 0, 1.5f}, {0, 1, 0})].front, 0.3f);
    EXPECT_EQ(trust[room.at({1.5f, 0.1f, 1.5f}, {0, 1, 0})].front, 1.0f);
}

TEST(Reliability, ShadowsEdgeTakesTheMostOfIt)
{
    for (const SurfelTrust& trust : reliabilityOf(varianceIn(greyRoom(), 1.0f), {})) {
        EXPECT_LT(trust.edges, 0.5f);
        EXPECT_EQ(trust.front, 1.0f);
    }
}

// About as much as there is may have been lost or let in.
TEST(Reliability, LittleLightIsLessSureThanMuch)
{
    const scenes::Surfaces room = greyRoom();
    SurfelLighting light = evenLight(room);
    light.irradiance[0] = glm::vec3(0.03f);
    const auto trust = reliabilityOf(varianceOf(scenes::hitListsOf(room, 64), light), {});
    EXPECT_LT(probability(trust[0]), 0.5f);
    EXPECT_GT(probability(trust[1]), 0.9f);
}

// Both ways alike.
TEST(Reliability, WhatWasCorrectedByMuchIsLessSureThanWhatWasByLittle)
{
    const std::vector<LightVariance> variance(4, LightVariance{});
    const float lit[] = {1.0f, 0.95f, std::exp(-0.25f), std::exp(0.25f)};
    const auto trust = reliabilityOf(variance, lit);
    EXPECT_GT(probability(trust[1]), 0.85f);
    EXPECT_LT(probability(trust[1]), probability(trust[0]));
    EXPECT_NEAR(probability(trust[2]), 0.5f, 0.05f);
    EXPECT_FLOAT_EQ(probability(trust[2]), probability(trust[3]));
}

TEST(Reliability, WhatIsLeftIsThatOfTheLightAndItsCorrection)
{
    const LightVariance before{.outside = 0.1f, .backs = 0.2f, .edges = 0.3f, .dark = 0.3975f};
    const float lit = std::exp(-1.0f);
    const float alone = varianceLeft({&before, 1}, {}).front();
    EXPECT_NEAR(alone, 0.28f * 0.28f, 1e-6f);
    EXPECT_NEAR(varianceLeft({&before, 1}, {&lit, 1}).front(), alone + 0.72f * 0.72f, 1e-5f);
}

TEST(Reliability, IsANumberWhateverTheLightErrsBy)
{
    const LightVariance endless{.edges = std::numeric_limits<float>::infinity()};
    EXPECT_LT(varianceLeft({&endless, 1}, {}).front(), 1e7f);
    const SurfelTrust trust = reliabilityOf({&endless, 1}, {}).front();
    EXPECT_NEAR(trust.seen * trust.front, 1.0f, 1e-3f);
    EXPECT_LT(trust.edges, 0.01f);
}

// The mean of an exponential distribution that is cut off at 1: 1 - x + 1 / (exp(1 / x) - 1) is
// left.
TEST(Reliability, WhereTheMeshHasGapsLightThatIsNotSureWasLetInAndHalfOfItAtMost)
{
    EXPECT_EQ(shareExpected({}, 1.0f), 1.0f);
    EXPECT_EQ(shareExpected({.outside = 1.0f}, 1.0f), 1.0f); // no gap of the mesh lets that in
    EXPECT_EQ(shareExpected({.edges = 1.0f}, 0.0f), 1.0f);
    EXPECT_NEAR(shareExpected({.dark = 0.01f}, 1.0f), 0.8f + 1.0f / std::expm1(5.0f), 1e-5f);
    EXPECT_NEAR(shareExpected({.edges = 0.01f, .dark = 0.01f}, 0.5f),
                0.85f + 1.0f / std::expm1(1.0f / 0.15f), 1e-5f);
    EXPECT_NEAR(shareExpected({.backs = 1.0f}, 1.0f), 1.0f / std::expm1(0.5f) - 1.0f, 1e-5f);
    EXPECT_NEAR(shareExpected({.edges = std::numeric_limits<float>::infinity()}, 1.0f), 0.5f,
                1e-3f);
}

// By its share of the logarithm: two alike causes each take the root.
TEST(Reliability, CausesShareTheDoubt)
{
    const LightVariance variance[] = {{.outside = 0.2f, .backs = 0.2f}, {.outside = 0.4f}};
    const auto trust = reliabilityOf(variance, {});
    EXPECT_FLOAT_EQ(trust[0].seen, trust[0].front);
    EXPECT_FLOAT_EQ(trust[0].seen * trust[0].front, trust[1].seen);
    EXPECT_GT(trust[1].edges, 0.99f); // as unsure as any light
}

// A curve that may be another by a tenth of its slope puts what is three stops darker than the rest
// off by a fifth, and the rest by nothing: that is the room's one scale.
TEST(Reliability, AResponseThatIsNotKnownCountsFarFromTheUsualBrightness)
{
    const std::vector<glm::vec3> texture{glm::vec3(0.4f), glm::vec3(0.05f)};
    const std::vector<float> area{1000.0f, 1.0f};
    SlopeCovariance slopes;
    slopes.fill(0.1f * 0.1f); // all alike
    const std::vector<float> variance = varianceOfResponse(texture, area, slopes);
    EXPECT_NEAR(std::sqrt(variance[0]), 0.0f, 1e-3f);
    EXPECT_NEAR(std::sqrt(variance[1]), 0.1f * std::log(8.0f), 1e-3f);
    EXPECT_TRUE(varianceOfResponse(texture, area, {}).empty());
    const std::vector<LightVariance> light(2, LightVariance{});
    const auto trust = reliabilityOf(light, {}, variance);
    EXPECT_GT(probability(trust[0]), 0.95f);
    EXPECT_LT(probability(trust[1]), 0.6f);
}

} // namespace relamp
