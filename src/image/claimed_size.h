#pragma once

#include "image/picture.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace relamp
{

/// The size that a WebP or a BMP says that it has, with the fewest channels that it can have.
/// OpenImageIO makes room for all pixels of these when it opens them, before it can be asked. None
/// of another format, or where the file ends before.
std::optional<PictureHeader> claimedSize(std::span<const std::byte> bytes,
                                         const std::string& format);

} // namespace relamp
