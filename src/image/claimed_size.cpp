#include "image/claimed_size.h"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace relamp
{
namespace
{

using Bytes = std::span<const std::byte>;

/// `size` bytes at a place, the lowest first.
uint32_t wordAt(Bytes bytes, size_t at, size_t size)
{
    uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, size);
    return word;
}

PictureHeader sized(int64_t width, int64_t height, int channels)
{
    return {.width = width, .height = height, .channels = channels};
}

/// In its first chunk: a frame of VP8, a stream of VP8L, or VP8X, which names the canvas of what
/// follows (RFC 9649, 2.5 to 2.7).
std::optional<PictureHeader> sizeOfWebp(Bytes bytes)
{
    constexpr size_t kContent = 20; // behind "RIFF", "WEBP", and the chunk's name and length
    constexpr uint32_t kFourteenBits = 0x3fff;
    if (bytes.size() < kContent + 10) return std::nullopt;
    const std::string_view chunk(reinterpret_cast<const char*>(bytes.data()) + 12, 4);
    if (chunk == "VP8X")
        return sized(wordAt(bytes, kContent + 4, 3) + 1, wordAt(bytes, kContent + 7, 3) + 1, 3);
    if (chunk == "VP8 ")
        return sized(wordAt(bytes, kContent + 6, 2) & kFourteenBits,
                     wordAt(bytes, kContent + 8, 2) & kFourteenBits, 3);
    if (chunk != "VP8L") return std::nullopt;
    const uint32_t sizes = wordAt(bytes, kContent + 1, 4);
    return sized((sizes & kFourteenBits) + 1, (sizes >> 14 & kFourteenBits) + 1, 3);
}

/// Behind the length of its header, which is short in OS/2's. A negative height is one that begins
/// at the top.
std::optional<PictureHeader> sizeOfBmp(Bytes bytes)
{
    constexpr size_t kHeader = 14;
    constexpr uint32_t kShort = 12;
    if (bytes.size() < kHeader + kShort) return std::nullopt;
    if (wordAt(bytes, kHeader, 4) == kShort)
        return sized(wordAt(bytes, kHeader + 4, 2), wordAt(bytes, kHeader + 6, 2), 1);
    const auto height = static_cast<int32_t>(wordAt(bytes, kHeader + 8, 4));
    return sized(static_cast<int32_t>(wordAt(bytes, kHeader + 4, 4)), std::abs(int64_t{height}), 1);
}

} // namespace

std::optional<PictureHeader> claimedSize(Bytes bytes, const std::string& format)
{
    if (format == "webp") return sizeOfWebp(bytes);
    if (format == "bmp") return sizeOfBmp(bytes);
    return std::nullopt;
}

} // namespace relamp
