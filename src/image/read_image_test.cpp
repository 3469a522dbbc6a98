#include "relamp/image.h"

#include "scenes/pictures.h"
#include "scenes/refusal.h"
#include "scenes/temporary_folder.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <thread>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::fourColors;
using scenes::pictureFile;
using scenes::Pixels;
using testing::AnyOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

using Bytes = std::vector<uint8_t>;

Image read(const Bytes& bytes, Transfer transfer = Transfer::automatic,
           const std::string& name = "picture")
{
    return readImage(std::as_bytes(std::span(bytes)), name, transfer);
}

std::string refusal(const Bytes& bytes)
{
    return scenes::refusalOf([&] { read(bytes, Transfer::automatic, "picture.tga"); });
}

glm::vec3 pixel(const Image& image, size_t i)
{
    return Radiance(image)[i];
}

float distance(const Image& image, size_t i, glm::vec3 expected)
{
    return glm::length(pixel(image, i) - expected);
}

/// IEEE's, with infinities and all.
float anyHalf(uint16_t bits)
{
    const int exponent = bits >> 10 & 31;
    const auto mantissa = static_cast<float>(bits & 1023);
    const float sign = bits >> 15 != 0 ? -1.0f : 1.0f;
    if (exponent == 0) return sign * std::ldexp(mantissa, -24);
    if (exponent < 31) return sign * std::ldexp(1024.0f + mantissa, exponent - 25);
    return mantissa == 0.0f ? sign * std::numeric_limits<float>::infinity()
                            : std::numeric_limits<float>::quiet_NaN();
}

/// Sixteen by sixteen of noise: no codec finds much to leave out.
Pixels<uint8_t> noise()
{
    std::mt19937 random(1);
    Pixels<uint8_t> pixels{16, 16, 3, Bytes(768)};
    for (uint8_t& sample : pixels.samples) sample = static_cast<uint8_t>(random());
    return pixels;
}

} // namespace

TEST(ReadImage, EveryLosslessFormatOfBytesGivesThemBack)
{
    for (const char* format : {"png", "tiff", "bmp", "targa"}) {
        const Image image =
            read(pictureFile(format, fourColors()), Transfer::automatic, "picture.tga");
        EXPECT_EQ(image.width, 2) << format;
        EXPECT_EQ(image.encoded(), fourColors().samples) << format;
        EXPECT_EQ(image.transfer, Transfer::srgb) << format;
        EXPECT_TRUE(image.clipsAtWhite) << format;
        EXPECT_FALSE(image.wasJpeg) << format;
        EXPECT_THAT(image.alpha, IsEmpty()) << format;
    }
}

TEST(ReadImage, LossyFormatsAreNear)
{
    for (const char* format : {"jpeg", "webp"}) {
        const Image image = read(pictureFile(format, Pixels<uint8_t>{8, 8, 3, Bytes(192, 100)}));
        EXPECT_EQ(image.wasJpeg, format == std::string("jpeg"));
        EXPECT_THAT(image.encoded(), Each(testing::AllOf(testing::Ge(98), testing::Le(102))))
            << format;
    }
}

TEST(ReadImage, OnlyAJpegThatHalvesColourIsSharpened)
{
    Pixels<uint8_t> picture{16, 16, 3, {}};
    for (int i = 0; i < 16 * 16; ++i) // an edge within a stored sample of colour
        if (i % 16 < 7)
            picture.samples.insert(picture.samples.end(), {160, 60, 50});
        else
            picture.samples.insert(picture.samples.end(), {190, 200, 170});
    const auto redAtEdge = [](const Bytes& file) { return read(file).encoded()[3 * (8 * 16 + 6)]; };
    EXPECT_NEAR(redAtEdge(pictureFile("jpeg", picture)), 160, 3);
    EXPECT_NEAR(redAtEdge(pictureFile("jpeg", picture, "4:2:0")), 160, 12);
    EXPECT_NEAR(redAtEdge(pictureFile("jpeg", picture, "4:2:2")), 160, 12);
    // Any format can carry the word.
    const Pixels<float> grey{2, 1, 3, std::vector<float>(6, 0.5f)};
    EXPECT_FLOAT_EQ(pixel(read(pictureFile("openexr", grey, "4:2:0")), 1).g, 0.5f);
}

TEST(ReadImage, PalettesAreLookedUp)
{
    EXPECT_EQ(read(scenes::palettePng()).encoded(), fourColors().samples);
}

TEST(ReadImage, GreyIsSpreadOverTheColours)
{
    const Image image = read(pictureFile("png", Pixels<uint8_t>{2, 1, 1, {7, 200}}));
    EXPECT_THAT(image.encoded(), ElementsAre(7, 7, 7, 200, 200, 200));
}

TEST(ReadImage, OpacityIsKeptApartAndLeavesColoursAlone)
{
    const Image rgba =
        read(pictureFile("png", Pixels<uint8_t>{2, 1, 4, {10, 20, 30, 0, 40, 50, 60, 128}}));
    EXPECT_THAT(rgba.encoded(), ElementsAre(10, 20, 30, 40, 50, 60));
    EXPECT_THAT(rgba.alpha, ElementsAre(0, 128));

    const Image opaque = read(pictureFile("png", Pixels<uint8_t>{1, 1, 4, {10, 20, 30, 255}}));
    EXPECT_THAT(opaque.alpha, IsEmpty());

    const Image greyAlpha = read(pictureFile("png", Pixels<uint8_t>{2, 1, 2, {9, 0, 11, 255}}));
    EXPECT_THAT(greyAlpha.encoded(), ElementsAre(9, 9, 9, 11, 11, 11));
    EXPECT_THAT(greyAlpha.alpha, ElementsAre(0, 255));
}

// 32896 / 65535 = 0.50196; sRGB makes 0.2159 of it.
TEST(ReadImage, SixteenBitsAreSrgbInHalfFloats)
{
    for (const char* format : {"png", "tiff"}) {
        const Image image = read(pictureFile(format, Pixels<uint16_t>{1, 1, 3, {0, 32896, 65535}}));
        EXPECT_FALSE(image.isEncoded());
        EXPECT_LT(distance(image, 0, {0.0f, 0.2159f, 1.0f}), 2e-4f) << format;
        EXPECT_TRUE(image.clipsAtWhite);
    }
}

TEST(ReadImage, FloatsAreLinearAndMayBeBrighterThanWhite)
{
    for (const char* format : {"openexr", "tiff", "hdr"}) {
        const Image image = read(pictureFile(format, Pixels<float>{1, 1, 3, {0.25f, 0.5f, 8.0f}}));
        EXPECT_LT(distance(image, 0, {0.25f, 0.5f, 8.0f}), 0.05f) << format;
        EXPECT_FALSE(image.clipsAtWhite);
    }
}

TEST(ReadImage, TransferOverridesTheType)
{
    const Bytes bytes = pictureFile("png", Pixels<uint8_t>{1, 1, 1, {188}});
    EXPECT_NEAR(pixel(read(bytes, Transfer::linear), 0).r, 188.0f / 255.0f, 1e-6f);
    EXPECT_NEAR(pixel(read(bytes, Transfer::srgb), 0).r, 0.5029f, 1e-3f);

    const Bytes words = pictureFile("png", Pixels<uint16_t>{1, 1, 1, {32896}});
    EXPECT_NEAR(pixel(read(words, Transfer::linear), 0).r, 0.502f, 1e-3f);

    const Bytes floats = pictureFile("openexr", Pixels<float>{1, 1, 3, {0.5f, 0.5f, 0.5f}});
    EXPECT_NEAR(pixel(read(floats, Transfer::srgb), 0).r, 0.2140f, 1e-3f);
}

TEST(ReadImage, NanInfinityAndDarkerThanBlackAreBlack)
{
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const Image image = read(pictureFile(
        "openexr", Pixels<float>{2, 1, 3, {kNan, kInfinity, -kInfinity, -1.0f, 1e9f, 0.5f}}));
    EXPECT_EQ(pixel(image, 0), glm::vec3(0.0f));
    EXPECT_EQ(pixel(image, 1), glm::vec3(0.0f, 65504.0f, 0.5f)); // the largest half
}

// Half floats go another way than floats: every one there is, as colour, as grey and as opacity.
TEST(ReadImage, HalfFloatsAreReadAsTheFloatsThatTheyAre)
{
    for (const int channels : {1, 3, 4}) {
        Pixels<float> all{256, 256, channels, {}};
        for (uint32_t i = 0; i < 65536; ++i)
            for (uint32_t c = 0; c < static_cast<uint32_t>(channels); ++c)
                all.samples.push_back(anyHalf(static_cast<uint16_t>(i * (2 * c + 1))));
        for (const Transfer transfer : {Transfer::linear, Transfer::srgb}) {
            const Image asFloats = read(pictureFile("openexr", all), transfer);
            const Image asHalves = read(pictureFile("openexr", all, "", "half"), transfer);
            EXPECT_EQ(asHalves.half(), asFloats.half()) << channels;
            EXPECT_EQ(asHalves.alpha, asFloats.alpha) << channels;
        }
    }
}

TEST(ReadImage, AFourthChannelThatIsNoOpacityIsPassedOver)
{
    Pixels<float> depth{1, 1, 3, {0.25f, 0.5f, 0.75f}};
    const Image image = read(pictureFile("tiff", depth));
    EXPECT_THAT(image.alpha, IsEmpty());
}

TEST(ReadImage, FilesAreKnownByContentNotByName)
{
    const scenes::TemporaryFolder folder;
    EXPECT_EQ(readImage(folder.write("picture.jpg", pictureFile("png", fourColors()))).encoded(),
              fourColors().samples);
}

TEST(ReadImage, WhatIsNoPictureIsNamedAsSuch)
{
    const Bytes hello{'h', 'e', 'l', 'l', 'o'};
    for (const Bytes& bytes : {hello, Bytes()})
        EXPECT_THAT(scenes::refusalOf([&] { read(bytes); }),
                    StartsWith("picture: is no picture that relamp reads"));
    EXPECT_THAT(refusal({0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'}),
                HasSubstr("KTX2"));
}

/// Cut off every `1 / cuts` of its length, up to `share` of it.
void expectCutOffRefused(const Bytes& whole, const std::string& format, double share, size_t cuts)
{
    const auto end = static_cast<size_t>(static_cast<double>(whole.size()) * share);
    for (size_t size = 1; size < end; size += 1 + whole.size() / cuts)
        EXPECT_THAT(refusal({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}),
                    HasSubstr("picture"))
            << format << " cut at " << size << " of " << whole.size();
}

TEST(ReadImage, CutOffPicturesAreRefusedWhereverTheyEnd)
{
    for (const char* format : {"png", "jpeg"})
        expectCutOffRefused(pictureFile(format, noise()), format, 0.9, 20);
}

TEST(ReadImage, CutOffPicturesOfOtherFormatsAreRefused)
{
    for (const char* format : {"webp", "tiff", "bmp"})
        expectCutOffRefused(pictureFile(format, noise()), format, 0.9, 20);
    // Behind the pixels of a Targa are words about them.
    expectCutOffRefused(pictureFile("targa", noise()), "targa", 0.5, 20);
    Pixels<float> floats{16, 16, 3, std::vector<float>(768)};
    for (size_t i = 0; i < 768; ++i) floats.samples[i] = static_cast<float>(noise().samples[i]);
    for (const char* format : {"openexr", "hdr"})
        expectCutOffRefused(pictureFile(format, floats), format, 0.9, 40);
}

TEST(ReadImage, AFlippedBitInAPngIsAlwaysSeen)
{
    const Bytes whole = scenes::palettePng();
    for (size_t bit = 0; bit < 8 * whole.size(); ++bit) {
        Bytes broken = whole;
        broken[bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
        EXPECT_NE(refusal(broken), "") << "bit " << bit;
    }
}

void expectFlippedBitsDoNoHarm(const char* format)
{
    std::mt19937 random(7);
    const Bytes whole = pictureFile(format, noise());
    for (int i = 0; i < 20; ++i) {
        Bytes broken = whole;
        broken[random() % whole.size()] ^= static_cast<uint8_t>(1u << random() % 8);
        // A bit of a colour may flip unseen.
        EXPECT_THAT(refusal(broken), AnyOf(IsEmpty(), StartsWith("picture")));
    }
}

TEST(ReadImage, FlippedBitsDoNoHarm)
{
    for (const char* format : {"png", "jpeg"}) expectFlippedBitsDoNoHarm(format);
}

TEST(ReadImage, FlippedBitsOfOtherFormatsDoNoHarm)
{
    for (const char* format : {"webp", "tiff", "bmp", "targa", "openexr", "hdr"})
        expectFlippedBitsDoNoHarm(format);
}

/// The memory that a child may take is at its end; under a sanitizer its allocator is.
testing::Matcher<std::string> refusesGreed()
{
    return AnyOf(HasSubstr("asks for far more memory"), HasSubstr("fails on it"));
}

TEST(ReadImage, ExrAttributesThatTheFileCannotHoldAreRefused)
{
    Bytes bytes(200, 7);
    const std::array<uint8_t, 16> head{0x76, 0x2f, 0x31, 0x01, 2,    0,    0,    0,
                                       'a',  0,    'b',  0,    0xff, 0xff, 0xff, 0x6f};
    std::copy(head.begin(), head.end(), bytes.begin());
    EXPECT_THAT(refusal(bytes), refusesGreed());
}

TEST(ReadImage, ExrSizesThatTheFileCannotHoldAreRefused)
{
    Bytes bytes = pictureFile("openexr", noise());
    const std::string name = "dataWindow";
    const auto window = std::search(bytes.begin(), bytes.end(), name.begin(), name.end());
    ASSERT_NE(window, bytes.end());
    window[10 + 1 + 6 + 4 + 8 + 2] = 0x7f; // its right edge, in millions
    EXPECT_THAT(refusal(bytes), refusesGreed());
}

TEST(ReadImage, PicturesOfAnyFormatAreReadOnManyThreadsAtOnceAndLeaveNothingOpen)
{
    const auto openFiles = [] {
        const std::filesystem::directory_iterator files("/proc/self/fd");
        return std::distance(begin(files), end(files));
    };
    const Bytes exr = pictureFile("openexr", noise());
    const Bytes tiff = pictureFile("tiff", noise());
    const Image one = read(exr);
    const auto before = openFiles();
    std::atomic<int> same = 0;
    std::vector<std::thread> threads;
    for (int i = 0; i < 8; ++i)
        threads.emplace_back([&] {
            for (int j = 0; j < 3; ++j) {
                same += read(exr).half() == one.half() ? 1 : 0;
                same += read(tiff).encoded() == noise().samples ? 1 : 0;
                refusal({exr.begin(), exr.begin() + 400});
            }
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(same, 48);
    EXPECT_EQ(openFiles(), before);
}

/// OpenImageIO's reader would read what lies before the file in memory.
TEST(ReadImage, LinesBeforeTheFileAreRefused)
{
    Bytes bytes = pictureFile("openexr", noise());
    const std::string name = "screenWindowWidth";
    const auto last = std::search(bytes.begin(), bytes.end(), name.begin(), name.end());
    ASSERT_NE(last, bytes.end());
    const auto offset = last + 17 + 1 + 6 + 4 + 4 + 1; // then the header's end
    std::fill(offset, offset + 8, uint8_t{0xff});
    EXPECT_THAT(refusal(bytes), HasSubstr("cannot be decoded"));
}

using TiffTags = std::vector<std::array<uint16_t, 2>>;

/// Eight bits of RGB, not packed, of 64 by 64, with more words about where it lies.
Bytes tiffOf(const TiffTags& more, size_t size)
{
    TiffTags tags{{256, 64}, {257, 64}, {258, 8}, {259, 1}, {262, 2}, {277, 3}};
    tags.insert(tags.end(), more.begin(), more.end());
    std::sort(tags.begin(), tags.end());
    Bytes bytes{'I', 'I', '*', 0, 8, 0, 0, 0};
    const auto append = [&bytes](uint16_t word) {
        bytes.push_back(static_cast<uint8_t>(word & 0xff));
        bytes.push_back(static_cast<uint8_t>(word >> 8));
    };
    append(static_cast<uint16_t>(tags.size()));
    for (const auto& [tag, value] : tags)
        for (const int word : {int{tag}, 3, 1, 0, int{value}, 0})
            append(static_cast<uint16_t>(word));
    bytes.resize(size);
    return bytes;
}

/// One tile, of which next to nothing is there.
Bytes tiffOfATile(uint16_t side)
{
    return tiffOf({{322, side}, {323, side}, {324, 200}, {325, 100}}, 300);
}

// libtiff warns and OpenImageIO goes on: without a word, the rest was black.
TEST(ReadImage, TiffsThatAreNotPackedAreRefusedWhereverTheyEnd)
{
    constexpr uint16_t kPixels = 64 * 64 * 3;
    const auto tiff = [](size_t size) {
        return tiffOf({{273, 200}, {278, 64}, {279, kPixels}}, size); // a strip, its lines, bytes
    };
    EXPECT_EQ(read(tiff(200 + kPixels)).encoded(), Bytes(kPixels, 0));
    for (const size_t missing : {size_t{1}, size_t{100}, size_t{kPixels}})
        EXPECT_THAT(refusal(tiff(200 + kPixels - missing)), HasSubstr("it is cut off")) << missing;
}

TEST(ReadImage, TilesThatTheFileCannotHoldAreRefusedBeforeThereIsRoomForThem)
{
    EXPECT_THAT(refusal(tiffOfATile(16384)), HasSubstr("claims tiles of 268435456 pixels"));
    EXPECT_THAT(refusal(tiffOfATile(64)), HasSubstr("cannot be decoded"));
}

TEST(ReadImage, SizesThatTheFileCannotHoldAreRefusedBeforeThereIsRoomForThem)
{
    EXPECT_THAT(refusal(scenes::pngClaiming(60000, 60000)),
                HasSubstr("claims 60000 x 60000 pixels"));
    EXPECT_THAT(refusal(scenes::pngClaiming(20000, 20000)), HasSubstr("but the file has only"));
}

// OpenImageIO makes room for these as it opens them, before it can be asked for their size.
TEST(ReadImage, SizesThatAreLiesAreRefusedInAnyFormat)
{
    Bytes webp = pictureFile("webp", noise());
    std::fill_n(webp.begin() + 26, 4, uint8_t{0x3f}); // width and height of a frame of VP8
    EXPECT_THAT(refusal(webp), StartsWith("picture.tga: "));
    Bytes bmp = pictureFile("bmp", noise());
    bmp[20] = bmp[24] = 1; // width and height beyond 65536
    bmp[28] = 8;           // bits a pixel
    bmp[30] = 1;           // run lengths
    EXPECT_THAT(refusal(bmp), StartsWith("picture.tga: "));
    Bytes targa = pictureFile("targa", noise());
    targa[13] = targa[15] = 0xff; // 65296 x 65296
    EXPECT_THAT(refusal(targa), StartsWith("picture.tga: "));
}

} // namespace relamp
