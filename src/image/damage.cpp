#include "image/damage.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>

#include <zlib.h>

namespace relamp
{
namespace
{

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";
constexpr size_t kWord = 4;

uint32_t bigEndianWord(std::span<const std::byte> bytes)
{
    uint32_t word = 0;
    for (const std::byte byte : bytes.first(kWord)) word = word << 8 | static_cast<uint32_t>(byte);
    return word;
}

uint32_t crcOf(std::span<const std::byte> bytes)
{
    return static_cast<uint32_t>(
        crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

} // namespace

// Entropy-coded data cannot contain a marker, so a whole file has an end marker behind its last
// scan.
bool isWholeJpeg(std::span<const std::byte> bytes)
{
    const auto isMarker = [&](std::byte code, size_t i) {
        return bytes[i] == std::byte{0xff} && bytes[i + 1] == code;
    };
    for (size_t i = bytes.size(); i-- > 1;) {
        if (isMarker(std::byte{0xd9}, i - 1)) return true;
        if (isMarker(std::byte{0xda}, i - 1)) return false;
    }
    return false;
}

// A chunk is a length, a type, as many bytes as the length says, and a checksum of type and bytes.
// A small letter begins the types that a reader can do without.
bool isWholePng(std::span<const std::byte> bytes)
{
    if (bytes.size() < kPngSignature.size() ||
        std::memcmp(bytes.data(), kPngSignature.data(), kPngSignature.size()) != 0)
        return false;
    bytes = bytes.subspan(kPngSignature.size());
    while (bytes.size() >= 3 * kWord) {
        const size_t length = bigEndianWord(bytes);
        if (length > bytes.size() - 3 * kWord) return false;
        const auto typeAndContent = bytes.subspan(kWord, kWord + length);
        if (crcOf(typeAndContent) != bigEndianWord(bytes.subspan(2 * kWord + length))) return false;
        if (std::memcmp(typeAndContent.data(), "IEND", kWord) == 0) return true;
        bytes = bytes.subspan(3 * kWord + length);
    }
    return false;
}

} // namespace relamp
