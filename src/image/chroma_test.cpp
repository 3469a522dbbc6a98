#include "image/chroma.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr int kSize = 40;
constexpr size_t kPixels = size_t{kSize} * kSize;

float brightnessOf(glm::vec3 color)
{
    return 0.299f * color.r + 0.587f * color.g + 0.114f * color.b;
}

/// Two paints that meet at column `edge`, as floats 0..255.
std::vector<glm::vec3> twoPaints(glm::vec3 left, glm::vec3 right, int edge)
{
    std::vector<glm::vec3> picture;
    for (size_t i = 0; i < kPixels; ++i)
        picture.push_back(static_cast<int>(i % kSize) < edge ? left : right);
    return picture;
}

/// Brightness as it is; colour differences as means of 2 x 2 pixels, as JPEG's 4:2:0 keeps them.
std::vector<uint8_t> halvedChroma(const std::vector<glm::vec3>& picture)
{
    std::vector<uint8_t> rgb;
    for (size_t i = 0; i < kPixels; ++i) {
        const size_t corner = i / kSize / 2 * 2 * kSize + i % kSize / 2 * 2;
        glm::vec3 mean(0.0f);
        for (const size_t k : {size_t{0}, size_t{1}, size_t{kSize}, size_t{kSize} + 1})
            mean += 0.25f * picture[corner + k];
        const glm::vec3 color = brightnessOf(picture[i]) + mean - brightnessOf(mean);
        for (int c = 0; c < 3; ++c)
            rgb.push_back(static_cast<uint8_t>(glm::clamp(color[c], 0.0f, 255.0f) + 0.5f));
    }
    return rgb;
}

/// Largest difference of a channel from the picture.
float worst(const std::vector<uint8_t>& rgb, const std::vector<glm::vec3>& picture)
{
    float largest = 0.0f;
    for (size_t i = 0; i < kPixels; ++i)
        for (int c = 0; c < 3; ++c)
            largest =
                std::max(largest, std::abs(static_cast<float>(rgb[3 * i + static_cast<size_t>(c)]) -
                                           picture[i][c]));
    return largest;
}

} // namespace

TEST(Chroma, ColoursThatRanOverAnEdgeGoBack)
{
    const auto picture = twoPaints({160, 60, 50}, {190, 200, 170}, 19);
    auto rgb = halvedChroma(picture);
    EXPECT_GT(worst(rgb, picture), 35.0f);
    sharpenChroma(rgb, kSize, kSize);
    EXPECT_LT(worst(rgb, picture), 12.0f);
}

TEST(Chroma, AShadowOnOnePaintKeepsItsColour)
{
    const glm::vec3 paint(200, 120, 80);
    const auto picture = twoPaints(paint, 0.5f * paint, 20);
    auto rgb = halvedChroma(picture);
    sharpenChroma(rgb, kSize, kSize);
    EXPECT_LT(worst(rgb, picture), 2.0f);
}

TEST(Chroma, BrightnessStays)
{
    std::vector<uint8_t> rgb;
    for (size_t i = 0; i < kPixels; ++i)
        rgb.insert(rgb.end(), {static_cast<uint8_t>(100 + 2 * (i % kSize)),
                               static_cast<uint8_t>(90 + 3 * (i / kSize)), 120});
    const auto before = rgb;
    sharpenChroma(rgb, kSize, kSize);
    for (size_t i = 0; i < rgb.size(); i += 3)
        EXPECT_NEAR(brightnessOf({rgb[i], rgb[i + 1], rgb[i + 2]}),
                    brightnessOf({before[i], before[i + 1], before[i + 2]}), 1.0f);
}

TEST(Chroma, WhatIsBurntOutNeitherGivesNorTakesColour)
{
    const auto picture = twoPaints({255, 240, 200}, {240, 240, 240}, 20);
    auto rgb = halvedChroma(picture);
    sharpenChroma(rgb, kSize, kSize);
    EXPECT_LT(worst(rgb, picture), 1.0f);
}

TEST(Chroma, SmallPicturesAreNoTrouble)
{
    for (const int width : {1, 2, 5}) {
        std::vector<uint8_t> rgb(static_cast<size_t>(3 * width), 77);
        sharpenChroma(rgb, width, 1);
        EXPECT_EQ(rgb, std::vector<uint8_t>(rgb.size(), 77));
    }
}

} // namespace relamp
