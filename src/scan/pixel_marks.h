#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relamp
{

/// [page][pixel]: whether a pixel is one of some kind. A bit each: there are billions of them.
using PixelMarks = std::vector<std::vector<bool>>;

/// Bits of bytes that many threads wrote.
inline std::vector<bool> marksFrom(const std::vector<uint8_t>& bytes)
{
    std::vector<bool> marks(bytes.size());
    for (size_t i = 0; i < bytes.size(); ++i) marks[i] = bytes[i] != 0;
    return marks;
}

} // namespace relamp
