#include "image/texture_noise.h"

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

/// Of a page of bytes, as a camera without a curve gives them.
TextureNoise noiseOf(bool wasJpeg, Transfer transfer = Transfer::srgb)
{
    Image image;
    image.transfer = transfer;
    image.wasJpeg = wasJpeg;
    return textureNoiseOf(image, {});
}

float radianceOf(int byte)
{
    const float x = static_cast<float>(byte) / 255.0f;
    return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

} // namespace

TEST(TextureNoise, HidesWhatRoundingLeavesNothingOf)
{
    const TextureNoise noise = noiseOf(false);
    EXPECT_NEAR(hiddenShare(0.0f, noise), 1.0f, 1e-3f);
    // One step is one half of a byte either way: a deviation of 0.29 beside 0.4 of paint.
    EXPECT_NEAR(hiddenShare(radianceOf(1), noise), 0.33f, 0.02f);
    EXPECT_LT(hiddenShare(radianceOf(4), noise), 0.03f);
    EXPECT_EQ(hiddenShare(radianceOf(8), noise), 0.0f);
}

TEST(TextureNoise, HidesMoreInAJpeg)
{
    const TextureNoise noise = noiseOf(true);
    EXPECT_NEAR(hiddenShare(radianceOf(5), noise), 0.5f, 0.02f); // 2 of 5
    EXPECT_GT(hiddenShare(radianceOf(12), noise), 0.05f);
    EXPECT_EQ(hiddenShare(radianceOf(120), noise), 0.0f);
}

TEST(TextureNoise, NeverRisesWithTheLight)
{
    for (const TextureNoise& noise :
         {noiseOf(false), noiseOf(true), noiseOf(true, Transfer::linear)})
        for (float radiance = 1e-5f; radiance < 1.0f; radiance *= 1.05f)
            EXPECT_LE(hiddenShare(1.05f * radiance, noise), hiddenShare(radiance, noise) + 1e-6f);
}

// A contrast curve brings what is dark nearer to black.
TEST(TextureNoise, IsThatOfTheTextureAndNotOfTheLight)
{
    Response response;
    response.slope = {0.7f, 0.75f, 0.8f, 0.9f, 1.0f};
    const TextureNoise noise = textureNoiseOf(Image{}, response);
    EXPECT_NEAR(hiddenShare(response(radianceOf(1)), noise), 0.18f, 0.03f); // 0.7 of 0.29
    EXPECT_GT(radianceOfBlack(noise), 3.0f * radianceOfBlack(noiseOf(false)));
}

TEST(TextureNoise, FloatsHaveNone)
{
    Image image;
    image.clipsAtWhite = false;
    const TextureNoise noise = textureNoiseOf(image, {});
    EXPECT_EQ(hiddenShare(0.0f, noise), 0.0f);
    EXPECT_EQ(radianceOfBlack(noise), 0.0f);
}

} // namespace relamp
