#pragma once

#include <cstddef>
#include <span>

namespace relamp
{

/// What the headers of an EXR make a reader provide room for. OpenEXR does so before it looks
/// whether the file can hold it, and reads an attribute by its type, however long the header says
/// that it is.
struct ExrHeaders
{
    bool isSound = false; // not cut off, and without contradiction; what follows is void otherwise
    double unpacked = 0;  // bytes of all pixels and channels of the largest part, or of a tile
    double chunks = 0;    // of the part with the most tiles; the file holds 8 bytes for each
};
ExrHeaders readExrHeaders(std::span<const std::byte> bytes);

} // namespace relamp
