#include "image/write_image.h"
#include "relamp/image.h"

#include <cstdlib>

#include <gtest/gtest.h>

namespace relamp
{

TEST(Webp, IsReadAsItWasWrittenButForAStepOrTwo)
{
    constexpr Size kSize{64, 48};
    std::vector<uint8_t> rgb;
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x)
            for (const int value : {60 + 2 * x, 200 - 2 * y, 90 + x})
                rgb.push_back(static_cast<uint8_t>(value));
    const std::vector<uint8_t> webp = encodeWebp(rgb, kSize, 95, unwatched());
    ASSERT_FALSE(webp.empty());
    EXPECT_LT(webp.size(), rgb.size() / 4);
    const Image read = readImage(std::as_bytes(std::span(webp)), "picture");
    ASSERT_EQ(read.encoded().size(), rgb.size());
    int apart = 0;
    for (size_t i = 0; i < rgb.size(); ++i) apart += std::abs(read.encoded()[i] - rgb[i]);
    EXPECT_LT(apart, 2 * static_cast<int>(rgb.size()));
}

// So that who asked for it can write another format.
TEST(Webp, OfAPictureTooLargeForTheFormatIsNothing)
{
    const std::vector<uint8_t> rgb(size_t{3} * 16384, 128);
    EXPECT_TRUE(encodeWebp(rgb, {16384, 1}, 90, unwatched()).empty());
}

} // namespace relamp
