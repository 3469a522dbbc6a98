#pragma once

#include <cstddef>
#include <span>

namespace relamp
{

/// Whether a JPEG goes on to its end. libjpeg fills what is missing with grey and calls it a
/// warning.
bool isWholeJpeg(std::span<const std::byte> bytes);

/// Whether a PNG goes on to its end and is as it was written. libpng finds that out too, but tells
/// it to standard error.
bool isWholePng(std::span<const std::byte> bytes);

} // namespace relamp
