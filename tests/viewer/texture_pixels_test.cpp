#include "texture_pixels.h"

#include <cstring>

#include <gmock/gmock.h>

namespace
{

TEST(Rgb9e5, KeepsLightToAnEighthOfAPercentOfTheBrightest)
{
    for (const glm::vec3 light : {glm::vec3(0.5f, 0.25f, 0.01f), glm::vec3(1e-4f, 2e-4f, 3e-4f),
                                  glm::vec3(900.0f, 3.0f, 70.0f), glm::vec3(0.9999f)}) {
        const glm::vec3 read = fromRgb9e5(rgb9e5(light));
        const float most = std::max(light.r, std::max(light.g, light.b));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(read[c], light[c], 0.00125f * most + 4e-8f);
    }
}

TEST(Rgb9e5, HoldsTheEndsOfItsRange)
{
    EXPECT_EQ(fromRgb9e5(rgb9e5({0, -3, std::numeric_limits<float>::quiet_NaN()})), glm::vec3(0));
    EXPECT_EQ(fromRgb9e5(rgb9e5(glm::vec3(1e9f))), glm::vec3(65408.0f));
}

relamp::Page pageOf(int width, int height)
{
    relamp::Page page;
    page.image.width = width; // without pixels, which nobody looks at
    page.image.height = height;
    return page;
}

TEST(TextureLimits, ShowPagesAsTheyAreWhereTheyFit)
{
    constexpr uint64_t kGiB = uint64_t{1} << 30;
    relamp::Scan scan;
    scan.pages = {pageOf(8192, 8192), pageOf(2048, 1024)};
    const uint64_t large = uint64_t{8192} * 8192; // 25 bytes a pixel, and a third for levels

    EXPECT_EQ(TextureLimits({16384, 2 * kGiB, 4 * kGiB}).lengthFor(scan), 16384u);
    EXPECT_EQ(TextureLimits({4096, 2 * kGiB, 4 * kGiB}).lengthFor(scan), 4096u);
    EXPECT_EQ(TextureLimits({16384, 2 * kGiB, large * 25}).lengthFor(scan), 4096u);
    EXPECT_EQ(TextureLimits({16384, large * 4, 4 * kGiB}).lengthFor(scan), 4096u);
    // It has to be shown somehow.
    EXPECT_EQ(TextureLimits({16384, 2 * kGiB, 1000}).lengthFor(scan), 1024u);
}

relamp::Image checkered(int size)
{
    relamp::Image image;
    image.width = image.height = size;
    for (int i = 0; i < size * size; ++i)
        image.encoded().insert(image.encoded().end(), 3, (i / size + i) % 2 != 0 ? 255 : 0);
    return image;
}

// Black and white mix to half the light, which is 188 of 255 in sRGB, not 128.
TEST(TexturePixels, SmallerLevelsAreMeansOfLight)
{
    const TexturePixels pixels = texturePixels(checkered(8), TexelFormat::srgb8, 64, true);

    ASSERT_EQ(pixels.levels.size(), 4u);
    EXPECT_EQ(pixels.levels[1].width, 4u);
    EXPECT_EQ(std::to_integer<int>(pixels.bytes[pixels.levels[1].offset]), 188);
}

TEST(TexturePixels, WhatIsTooLargeIsHalvedFirst)
{
    const TexturePixels pixels = texturePixels(checkered(32), TexelFormat::rgb9e5, 8, true);

    EXPECT_EQ(pixels.levels[0].width, 8u);
    uint32_t texel = 0;
    std::memcpy(&texel, pixels.bytes.data(), 4);
    EXPECT_NEAR(fromRgb9e5(texel).g, 0.5f, 2e-3f);
}

} // namespace
