#pragma once

#include "image/picture.h"

#include <cstddef>
#include <span>

namespace relamp
{

/// Palettes are looked up, and fewer bits than eight widened. Throws UndecodablePicture. encodePng
/// is in write_image.h.
Picture readPng(std::span<const std::byte> bytes, const HeaderCheck& check);

} // namespace relamp
