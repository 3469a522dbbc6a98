#pragma once

#include "base/fail.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace relamp
{

/// A picture as it came, in memory.
struct PictureFile
{
    std::span<const std::byte> bytes;
    std::string name;   // what to call it in an error
    std::string format; // OpenImageIO's name of it
};

[[noreturn]] inline void undecodable(const PictureFile& file, const std::string& reason)
{
    malformed(file.name, fmt::format("cannot be decoded as {}: {}", file.format, reason));
}

/// What a picture file says of itself, before there is room for its pixels.
struct PictureHeader
{
    int64_t width = 0;
    int64_t height = 0;
    int64_t depth = 1;        // 1: flat
    double tilePixels = 0;    // of a tile, which is decoded as a whole; 0: in lines
    int channels = 0;         // as decoded
    int alphaChannel = -1;    // -1: none
    bool isOfBytes = true;    // a byte a sample
    bool isOfHalves = false;  // a half float a sample
    bool isOfFloats = false;  // brighter than white is possible
    bool halvesColor = false; // a JPEG that keeps colour coarser than brightness

    /// Of those that mean colour and opacity: 1, 2, 3 or 4, the first ones.
    [[nodiscard]] int channelsToRead() const
    {
        const int colors = channels >= 3 ? 3 : 1;
        return alphaChannel == colors ? colors + 1 : colors;
    }
};

/// A picture as its file has it: channelsToRead() samples a pixel, row after row, opacity not
/// multiplied in. They are bytes, any half floats, or floats: whole numbers of more than a byte are
/// floats of 0..1.
struct Picture
{
    PictureHeader header;
    std::variant<std::vector<uint8_t>, std::vector<uint16_t>, std::vector<float>> samples;
};

/// Looks at a header before there is room for the pixels, and throws where they are not wanted.
using HeaderCheck = std::function<void(const PictureHeader&)>;

/// With the decoder's reason.
class UndecodablePicture : public std::runtime_error
{
public:
    using runtime_error::runtime_error;
};

} // namespace relamp
