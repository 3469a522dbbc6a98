#include "relamp/scan.h"

#include "base/half.h"

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

Image greyImage(int width, int height, const std::vector<uint8_t>& greys)
{
    Image image{.width = width, .height = height};
    for (const uint8_t grey : greys) image.encoded().insert(image.encoded().end(), 3, grey);
    return image;
}

Scan scanOf(Image image, bool ofVertices = false)
{
    Scan scan;
    scan.pages.push_back({.name = "page", .image = std::move(image), .ofVertices = ofVertices});
    return scan;
}

TEST(Coarsened, AveragesLightAndNotBytes)
{
    const Scan scan = coarsened(scanOf(greyImage(2, 2, {255, 255, 0, 0})), 1);
    const Image& image = scan.pages[0].image;
    ASSERT_EQ(image.pixels(), 1);
    EXPECT_EQ(image.encoded()[0], 188); // sRGB of a half
}

TEST(Coarsened, SaysSoInItsOptions)
{
    Scan scan = scanOf(greyImage(12, 5, std::vector<uint8_t>(60, 7)));
    EXPECT_EQ(coarsened(scan, 3).options.longestSide, 3);
    scan.options.longestSide = 2;
    EXPECT_EQ(coarsened(scan, 3).options.longestSide, 2);
}

TEST(Coarsened, HalvesUntilTheLongerSideFits)
{
    const Scan scan = coarsened(scanOf(greyImage(12, 5, std::vector<uint8_t>(60, 7))), 3);
    const Image& image = scan.pages[0].image;
    EXPECT_EQ(image.width, 3);
    EXPECT_EQ(image.height, 2);
    EXPECT_EQ(image.encoded(), std::vector<uint8_t>(18, 7)); // of what there is, at the end too
}

TEST(Coarsened, KeepsFloatsAboveWhiteAndOpacity)
{
    Image image{.width = 2, .height = 1, .transfer = Transfer::linear, .clipsAtWhite = false};
    auto& half = image.rgb.emplace<std::vector<uint16_t>>();
    for (const float value : {2.0f, 6.0f}) half.insert(half.end(), 3, halfFromFloat(value));
    image.alpha = {0, 255};
    const Scan scan = coarsened(scanOf(image), 1);
    EXPECT_EQ(scan.pages[0].image.half()[2], halfFromFloat(4.0f));
    EXPECT_EQ(scan.pages[0].image.alpha[0], 128);
    EXPECT_FALSE(scan.pages[0].image.clipsAtWhite);
}

TEST(Coarsened, LeavesWhatFitsAndColoursOfVertices)
{
    const Image image = greyImage(4, 1, {1, 2, 3, 4});
    EXPECT_EQ(coarsened(scanOf(image), 4).pages[0].image.encoded(), image.encoded());
    EXPECT_EQ(coarsened(scanOf(image, true), 2).pages[0].image.encoded(), image.encoded());
}

} // namespace
} // namespace relamp
