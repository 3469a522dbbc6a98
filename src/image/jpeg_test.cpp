#include "image/jpeg.h"

#include "image/write_image.h"

#include <cstdio>
#include <cstdlib>
#include <span>

#include <gmock/gmock.h>
#include <jpeglib.h>

namespace relamp
{
namespace
{

using testing::Each;

void anySize(const PictureHeader& /*header*/) {}

/// Eight by eight alike pixels.
std::vector<uint8_t> jpegOf(std::span<const uint8_t> pixel, J_COLOR_SPACE space,
                            std::span<const jpeg_scan_info> scans = {})
{
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = jpeg.image_height = 8;
    jpeg.input_components = static_cast<int>(pixel.size());
    jpeg.in_color_space = space;
    jpeg_set_defaults(&jpeg);
    if (!scans.empty()) jpeg.scan_info = scans.data();
    jpeg.num_scans = static_cast<int>(scans.size());
    jpeg_start_compress(&jpeg, TRUE);
    std::vector<uint8_t> line;
    for (int i = 0; i < 8; ++i) line.insert(line.end(), pixel.begin(), pixel.end());
    for (int i = 0; i < 8; ++i) {
        uint8_t* row = line.data();
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    std::vector<uint8_t> file(bytes, bytes + size);
    std::free(bytes);
    return file;
}

} // namespace

TEST(Jpeg, WhatIsWrittenIsNearlyReadAgain)
{
    const auto file = encodeJpeg(std::vector<uint8_t>(3 * 16 * 8, 100), {16, 8});
    const Picture picture = readJpeg(std::as_bytes(std::span(file)), anySize);
    EXPECT_EQ(picture.header.width, 16);
    EXPECT_EQ(picture.header.height, 8);
    EXPECT_EQ(picture.header.channelsToRead(), 3);
    EXPECT_THAT(std::get<std::vector<uint8_t>>(picture.samples),
                Each(testing::AllOf(testing::Ge(99), testing::Le(101))));
}

// 200 of 255 of a colour under 128 of 255 of black: 200 * 128 / 255 = 100.
TEST(Jpeg, InksBecomeColours)
{
    constexpr uint8_t kInks[] = {200, 200, 200, 128}; // 255 is no ink
    const auto file = jpegOf(kInks, JCS_CMYK);
    const Picture picture = readJpeg(std::as_bytes(std::span(file)), anySize);
    EXPECT_EQ(picture.header.channelsToRead(), 3);
    const auto& samples = std::get<std::vector<uint8_t>>(picture.samples);
    EXPECT_EQ(samples.size(), 3u * 8 * 8);
    EXPECT_THAT(samples, Each(testing::AllOf(testing::Ge(98), testing::Le(102))));
}

TEST(Jpeg, ColoursThatNobodyKnowsAreRefused)
{
    constexpr uint8_t kTwo[] = {200, 128};
    const auto file = jpegOf(kTwo, JCS_UNKNOWN);
    EXPECT_THROW((void)readJpeg(std::as_bytes(std::span(file)), anySize), UndecodablePicture);
}

/// A progressive file that brings every frequency of every channel by itself.
TEST(Jpeg, MoreScansThanAnyPictureNeedsAreRefused)
{
    constexpr uint8_t kPixel[] = {200, 128, 60};
    std::vector<jpeg_scan_info> scans{{3, {0, 1, 2, 0}, 0, 0, 0, 0}};
    for (int part = 0; part < 3; ++part)
        for (int frequency = 1; frequency < 64; ++frequency)
            scans.push_back({1, {part, 0, 0, 0}, frequency, frequency, 0, 0});
    const auto many = jpegOf(kPixel, JCS_RGB, scans);
    EXPECT_THROW((void)readJpeg(std::as_bytes(std::span(many)), anySize), UndecodablePicture);
    const auto few = jpegOf(kPixel, JCS_RGB, std::span(scans).first(10));
    EXPECT_NO_THROW((void)readJpeg(std::as_bytes(std::span(few)), anySize));
}

} // namespace relamp
