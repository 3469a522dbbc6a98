#include "albedo/closed_loop.h"

#include "base/radiometry.shared.h"
#include "base/random.h"

#include <cmath>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

/// Grey places in ever brighter light, rendered `bias` too bright and with much noise.
std::vector<RenderedPlace> noisyPlaces(float bias, float noise)
{
    constexpr size_t kCount = 20000;
    std::vector<RenderedPlace> places(kCount);
    Random random(1, 2, 3);
    for (size_t i = 0; i < kCount; ++i) {
        const float shown = 0.5f * static_cast<float>(i + 1) / kCount;
        const auto rendered = [&] { return shown + bias + noise * (random.next() - 0.5f); };
        places[i] = {.area = 0.01f,
                     .scan = glm::vec3(shown),
                     .albedo = glm::vec3(0.5f),
                     .first = glm::vec3(rendered()),
                     .second = glm::vec3(rendered())};
    }
    return places;
}

} // namespace

// Two errors whose noise has nothing to do with each other multiply to the square of what both
// have: the bias. One error squared would be 0.13 here.
TEST(ClosedLoop, NoiseOfThePathsIsNoError)
{
    Verification found;
    compare(noisyPlaces(0.05f, 0.4f), found);
    EXPECT_NEAR(found.rmsError, 0.05f, 3.0f * found.standardError);
    EXPECT_LT(found.standardError, 0.003f);
    EXPECT_NEAR(found.psnr, -20.0f * std::log10(found.rmsError), 1e-3f);
    EXPECT_NEAR(found.ratio.g, 0.30f / 0.25f, 0.01f);
}

TEST(ClosedLoop, NothingIsSaidToBeBetterThanTheNoiseTells)
{
    Verification found;
    compare(noisyPlaces(0.0f, 0.4f), found);
    EXPECT_LT(found.standardError, 0.51f * found.rmsError);
    EXPECT_LT(found.psnr, 60.0f);
}

TEST(ClosedLoop, BinsAreFifthsFromDarkToBright)
{
    Verification found;
    compare(noisyPlaces(0.0f, 0.0f), found);
    std::vector<float> shading;
    for (const VerifiedBin& bin : found.bins) shading.push_back(bin.shading);
    const auto near = [](float value) { return testing::FloatNear(value, 1e-3f); };
    EXPECT_THAT(shading,
                testing::ElementsAre(near(0.1f), near(0.3f), near(0.5f), near(0.7f), near(0.9f)));
    EXPECT_EQ(found.psnr, 120.0f);
}

// What no light explains is told apart: there the whitest paper is too dark.
TEST(ClosedLoop, PlacesAsWhiteAsPaperAreAShareOfTheirOwn)
{
    std::vector<RenderedPlace> places = noisyPlaces(0.0f, 0.0f);
    for (size_t i = 0; i < places.size() / 4; ++i) {
        places[i].albedo = glm::vec3(kWhitePaint, 0.5f, 0.5f);
        places[i].first = places[i].second = places[i].scan - 0.2f;
    }
    Verification found;
    compare(places, found);
    EXPECT_NEAR(found.asWhiteAsPaper, 0.25f, 1e-4f);
    EXPECT_NEAR(found.rmsError, 0.1f, 1e-4f);
    EXPECT_LT(found.rmsErrorElsewhere, 1e-4f);
}

TEST(ClosedLoop, BurntOutPlacesDoNotCount)
{
    Verification found;
    compare(std::vector<RenderedPlace>(7), found);
    EXPECT_EQ(found.places, 0u);
    EXPECT_TRUE(found.bins.empty());
}

} // namespace relamp
