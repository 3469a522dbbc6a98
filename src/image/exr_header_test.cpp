#include "image/exr_header.h"

#include "scenes/pictures.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using namespace std::string_literals;

std::string word(int32_t value)
{
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
}

std::string attribute(const std::string& name, const std::string& type, const std::string& content)
{
    return name + '\0' + type + '\0' + word(static_cast<int32_t>(content.size())) + content;
}

std::string channel(const std::string& name, int32_t type)
{
    return name + '\0' + word(type) + word(0) + word(1) + word(1);
}

std::string window(int32_t width, int32_t height)
{
    return attribute("dataWindow", "box2i", word(0) + word(0) + word(width - 1) + word(height - 1));
}

ExrHeaders read(const std::string& attributes, int32_t version = 2)
{
    const std::string file = "\x76\x2f\x31\x01"s + word(version) + attributes + '\0';
    return readExrHeaders(std::as_bytes(std::span(file)));
}

const std::string kChannels =
    attribute("channels", "chlist", channel("A", 1) + channel("Z", 2) + '\0');

TEST(ExrHeader, ClaimsWhatItsPixelsTake)
{
    const ExrHeaders headers = read(kChannels + window(300, 200));
    EXPECT_TRUE(headers.isSound);
    EXPECT_EQ(headers.unpacked, 300.0 * 200.0 * (2 + 4));
    EXPECT_EQ(headers.chunks, 0.0);
}

TEST(ExrHeader, WrittenFilesAreSound)
{
    const auto file = scenes::pictureFile(
        "openexr", scenes::Pixels<float>{8, 4, 3, std::vector<float>(96, 0.5f)});
    const ExrHeaders headers = readExrHeaders(std::as_bytes(std::span(file)));
    EXPECT_TRUE(headers.isSound);
    EXPECT_EQ(headers.unpacked, 8.0 * 4.0 * 3 * 4);
}

TEST(ExrHeader, TilesAreCountedAndMayBeLargerThanThePicture)
{
    const std::string one = word(1) + word(1) + '\0';
    EXPECT_EQ(read(kChannels + window(30, 20) + attribute("tiles", "tiledesc", one)).chunks, 600.0);
    const std::string large = word(1 << 20) + word(1 << 20) + '\0';
    EXPECT_EQ(read(kChannels + window(30, 20) + attribute("tiles", "tiledesc", large)).unpacked,
              6.0 * (1 << 20) * (1 << 20));
    const std::string none = word(0) + word(1) + '\0';
    EXPECT_FALSE(read(kChannels + window(30, 20) + attribute("tiles", "tiledesc", none)).isSound);
}

TEST(ExrHeader, TheLargestOfAllPartsCounts)
{
    const std::string parts = kChannels + window(3, 2) + '\0' + kChannels + window(30, 20) +
                              attribute("chunkCount", "int", word(7)) + '\0';
    EXPECT_EQ(read(parts, 0x1002).unpacked, 600.0 * 6);
    EXPECT_EQ(read(parts, 0x1002).chunks, 7.0);
    EXPECT_EQ(read(parts).unpacked, 6.0 * 6); // one part, and pixels behind it
}

TEST(ExrHeader, AttributesEndWhereTheirTypeDoes)
{
    const std::string size = word(2) + word(1);
    for (const std::string& wrong : {
             attribute("channels", "chlist", channel("A", 1)), // without its end
             attribute("channels", "chlist", channel("A", 1) + '\0' + "more"),
             attribute("channels", "chlist", "A\0"s + word(1) + word(0) + word(0) + word(1) + '\0'),
             attribute("lineOrder", "lineOrder", "ab"),
             attribute("texts", "stringvector", word(9) + "short"),
             attribute("preview", "preview", size + word(7)),
             attribute("dataWindow", "box2i", word(3) + word(3) + word(1) + word(1)),
             "anything\0string\0"s + word(0x6fffffff),
             std::string(256, 'n') + '\0' + "int" + '\0' + word(4) + word(1),
         })
        EXPECT_FALSE(read(wrong).isSound) << wrong;
    for (const std::string& right : {
             attribute("texts", "stringvector", word(2) + "ab" + word(0)),
             attribute("preview", "preview", size + word(7) + word(8)),
             attribute("ours", "of no known type", "any bytes"),
         })
        EXPECT_TRUE(read(right).isSound) << right;
}

TEST(ExrHeader, NoPieceOfAFileIsSound)
{
    const std::string file = "\x76\x2f\x31\x01"s + word(2) + kChannels + window(300, 200) + '\0';
    const auto bytes = std::as_bytes(std::span(file));
    EXPECT_TRUE(readExrHeaders(bytes).isSound);
    for (size_t length = 0; length < file.size(); ++length)
        EXPECT_FALSE(readExrHeaders(bytes.first(length)).isSound) << length;
}

} // namespace
} // namespace relamp
