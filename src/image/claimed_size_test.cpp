#include "image/claimed_size.h"

#include "scenes/pictures.h"

#include <algorithm>
#include <vector>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using Bytes = std::vector<uint8_t>;
using ClaimedAs = glm::vec<2, int64_t>;

/// Of no more than the first bytes of a file.
ClaimedAs sizeOf(Bytes bytes, const std::string& format, size_t most = 32)
{
    bytes.resize(std::min(bytes.size(), most));
    const auto claimed = claimedSize(std::as_bytes(std::span(bytes)), format);
    return claimed ? ClaimedAs(claimed->width, claimed->height) : ClaimedAs(-1);
}

scenes::Pixels<uint8_t> picture(int width, int height, int channels)
{
    return {width, height, channels,
            Bytes(static_cast<size_t>(width) * static_cast<size_t>(height) *
                      static_cast<size_t>(channels),
                  77)};
}

TEST(ClaimedSize, IsThatOfWhatIsWritten)
{
    EXPECT_EQ(sizeOf(scenes::pictureFile("webp", picture(300, 20, 3)), "webp"), ClaimedAs(300, 20));
    EXPECT_EQ(sizeOf(scenes::pictureFile("webp", picture(300, 20, 4)), "webp"), ClaimedAs(300, 20));
    EXPECT_EQ(sizeOf(scenes::pictureFile("bmp", picture(300, 20, 3)), "bmp"), ClaimedAs(300, 20));
}

TEST(ClaimedSize, IsToldInEveryKindOfWebp)
{
    const Bytes riff{'R', 'I', 'F', 'F', 0, 0, 0, 0, 'W', 'E', 'B', 'P', 'V', 'P', '8'};
    const auto webp = [&](char kind, const Bytes& content) {
        Bytes bytes = riff;
        bytes.push_back(static_cast<uint8_t>(kind));
        bytes.insert(bytes.end(), 4, 0);
        bytes.insert(bytes.end(), content.begin(), content.end());
        return bytes;
    };
    // The largest of each: 14 bits less one, 14 bits, 24 bits.
    EXPECT_EQ(sizeOf(webp(' ', {0, 0, 0, 0x9d, 1, 0x2a, 0xff, 0x3f, 0xfe, 0x3f}), "webp"),
              ClaimedAs(16383, 16382));
    EXPECT_EQ(sizeOf(webp('L', {0x2f, 0xfe, 0xbf, 0xff, 0x0f, 0, 0, 0, 0, 0}), "webp"),
              ClaimedAs(16383, 16383));
    EXPECT_EQ(sizeOf(webp('X', {0, 0, 0, 0, 0xff, 0xff, 0xff, 0, 0, 1}), "webp"),
              ClaimedAs(1 << 24, (1 << 16) + 1));
}

TEST(ClaimedSize, OfABmpIsSignedOrShort)
{
    Bytes bytes(26, 0);
    bytes[14] = 40;
    bytes[18] = 5;
    std::fill_n(&bytes[22], 4, uint8_t{0xff}); // -1: a line, from the top
    EXPECT_EQ(sizeOf(bytes, "bmp"), ClaimedAs(5, 1));
    bytes[14] = 12; // OS/2's
    bytes[20] = 9;
    EXPECT_EQ(sizeOf(bytes, "bmp"), ClaimedAs(5, 9));
}

TEST(ClaimedSize, IsNotToldByAFileThatEndsBefore)
{
    const Bytes webp = scenes::pictureFile("webp", picture(30, 20, 3));
    const Bytes bmp = scenes::pictureFile("bmp", picture(30, 20, 3));
    for (size_t size = 0; size < 26; ++size) {
        EXPECT_EQ(sizeOf(webp, "webp", size), ClaimedAs(-1));
        EXPECT_EQ(sizeOf(bmp, "bmp", size), ClaimedAs(-1));
    }
    EXPECT_EQ(sizeOf(webp, "targa"), ClaimedAs(-1));
}

} // namespace
} // namespace relamp
