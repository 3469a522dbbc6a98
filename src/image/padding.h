#pragma once

#include <cstdint>
#include <span>

namespace relamp
{

/// Continues a picture into the pixels that nothing covers, so that no seam shows when it is
/// filtered or made into mip levels.
///
/// Push-pull (Gortler et al. 1996): a pixel that is not covered takes the mean of the covered ones
/// of the smallest mip level that has any, so every mip level is just what it would be from covered
/// pixels alone. `rgb` is 3 * width * height, `covered` is width * height, not 0 where the picture
/// counts. Nothing happens to a picture that is all covered, or not at all.
void fillPadding(std::span<uint16_t> rgb, std::span<const uint8_t> covered, int width, int height);
void fillPadding(std::span<uint8_t> rgb, std::span<const uint8_t> covered, int width, int height);

} // namespace relamp
