#include "albedo/confidence.h"

#include "albedo/layer_parts.h"
#include "base/radiometry.shared.h"
#include "image/burnt_out.shared.h"

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

constexpr float kDarkest = 0.02f;
const glm::vec3 kLit(1.0f);
const glm::vec3 kGrey(0.5f);

Confidence rated(glm::vec3 radiance, bool clips, glm::vec3 shading, SurfelTrust trust = {},
                 float hidden = 0.0f)
{
    return confidenceOf(radiance, brightestChannel(burntOutShares(radiance, clips)), shading,
                        kDarkest, trust, hidden);
}

} // namespace

TEST(Confidence, IsLostWhereTheTextureIsBurntOutOrUnlit)
{
    EXPECT_EQ(rated(glm::vec3(1.0f), true, kLit).value, 0.0f);
    EXPECT_EQ(rated({0.99f, 0.2f, 0.2f}, true, kLit).value, 0.0f); // one channel
    EXPECT_EQ(rated(glm::vec3(0.01f), true, glm::vec3(0.015f)).value, 0.0f);
    EXPECT_EQ(rated(kGrey, true, kLit).value, 1.0f);
    EXPECT_EQ(rated(kGrey, true, kLit).byte(), 255);
}

// A float texture says how bright its brightest is.
TEST(Confidence, IsKeptAboveWhiteWhereTheTextureDoesNotClip)
{
    EXPECT_EQ(rated(glm::vec3(7.0f), false, glm::vec3(9.0f)).value, 1.0f);
    EXPECT_EQ(rated(glm::vec3(7.0f), false, glm::vec3(0.01f)).value, 0.0f);
}

TEST(Confidence, FallsWithWhatNoiseOfTheTextureHides)
{
    const Confidence hidden = rated(kGrey, true, kLit, {}, 0.75f);
    EXPECT_EQ(hidden.value, 0.25f);
    EXPECT_EQ(hidden.doubt, Doubt::unlit);
}

TEST(Confidence, LowOneHasTheReasonThatWeighsMost)
{
    const auto why = [](glm::vec3 radiance, glm::vec3 shading, SurfelTrust trust) {
        return rated(radiance, true, shading, trust).doubt;
    };
    EXPECT_EQ(why(kGrey, kLit, {}), Doubt::none);
    EXPECT_EQ(why(glm::vec3(1.0f), kLit, {}), Doubt::clipped);
    EXPECT_EQ(why(glm::vec3(0.01f), glm::vec3(0.02f), {}), Doubt::unlit);
    EXPECT_EQ(why(kGrey, kLit, {.seen = 0.2f}), Doubt::unseen);
    EXPECT_EQ(why(kGrey, kLit, {.seen = 0.4f, .front = 0.3f}), Doubt::backFace);
    EXPECT_EQ(why(kGrey, kLit, {.edges = 0.1f}), Doubt::penumbra);
    EXPECT_EQ(why(kGrey, kLit, {.edges = 0.6f}), Doubt::none); // not low
}

// What shows more than white paint under the light that was found is whiter than paper, or got
// more.
TEST(Confidence, FallsWhereNoPaperIsAsWhite)
{
    const glm::vec3 light(0.45f);
    EXPECT_EQ(rated(kWhitePaint * light, true, light).value, 1.0f);
    EXPECT_NEAR(rated(1.5f * kWhitePaint * light, true, light).value, 0.5f, 1e-3f);
    EXPECT_EQ(rated(2.0f * kWhitePaint * light, true, light).doubt, Doubt::whiterThanPaper);
}

TEST(Confidence, DoubtsMultiply)
{
    EXPECT_NEAR(rated(kGrey, true, kLit, {.seen = 0.5f, .edges = 0.5f}).value, 0.25f, 1e-6f);
}

// It keeps the doubt that weighs more than that the texel stands for several places.
TEST(Confidence, OfTexelsOfSeveralPlacesIsAQuarter)
{
    PageLayers layers{.confidence = {255, 100, 40, 0},
                      .doubt = {Doubt::none, Doubt::unseen, Doubt::unlit, Doubt::clipped}};
    for (uint32_t pixel = 0; pixel < 4; ++pixel) doubtShared(pixel, layers);
    EXPECT_THAT(layers.confidence, testing::ElementsAre(64, 25, 10, 0));
    EXPECT_THAT(layers.doubt,
                testing::ElementsAre(Doubt::shared, Doubt::shared, Doubt::unlit, Doubt::clipped));
}

} // namespace relamp
