#include "image/png.h"

#include "image/write_image.h"
#include "relamp/error.h"

#include <numeric>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

std::vector<uint8_t> someSamples(int channels)
{
    std::vector<uint8_t> samples(static_cast<size_t>(5 * 3 * channels));
    std::iota(samples.begin(), samples.end(), uint8_t{1});
    return samples;
}

void anyPng(const PictureHeader& /*header*/) {}

} // namespace

TEST(Png, WhatIsWrittenIsReadAgain)
{
    for (const int channels : {1, 3, 4}) {
        const auto file = encodePng(someSamples(channels), {5, 3}, channels);
        const Picture picture = readPng(std::as_bytes(std::span(file)), anyPng);
        EXPECT_EQ(picture.header.width, 5);
        EXPECT_EQ(picture.header.height, 3);
        EXPECT_EQ(picture.header.channelsToRead(), channels);
        EXPECT_EQ(std::get<std::vector<uint8_t>>(picture.samples), someSamples(channels));
    }
}

TEST(Png, TheHeaderIsLookedAtFirst)
{
    auto file = encodePng(someSamples(3), {5, 3}, 3);
    file.resize(file.size() - 20); // the end, and some of the pixels before it
    const auto refuse = [](const PictureHeader& header) {
        if (header.width == 5) throw Error(ErrorCode::malformed, "is too wide");
    };
    EXPECT_THROW(readPng(std::as_bytes(std::span(file)), refuse), Error);
    EXPECT_THROW(readPng(std::as_bytes(std::span(file)), anyPng), UndecodablePicture);
}

} // namespace relamp
