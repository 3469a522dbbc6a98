#pragma once

#include "image/picture.h"

#include <cstddef>
#include <span>

namespace relamp
{

/// Grey or RGB; what was for printing (CMYK) becomes RGB. Throws UndecodablePicture. encodeJpeg is
/// in write_image.h.
Picture readJpeg(std::span<const std::byte> bytes, const HeaderCheck& check);

} // namespace relamp
