#pragma once

#include "relamp/progress.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace relamp
{

struct Size
{
    int width = 0;
    int height = 0;
};

/// RGBA of RGB, 3 a pixel, and opacity, one a pixel.
std::vector<uint8_t> withAlpha(std::span<const uint8_t> rgb, std::span<const uint8_t> alpha);

/// A PNG file of 8-bit samples: 1 channel grey, 3 RGB, 4 RGB and opacity. Throws
/// Error(cannotWrite).
std::vector<uint8_t> encodePng(std::span<const uint8_t> samples, Size size, int channels);

/// A JPEG file of 8-bit RGB in a quality that no eye tells from the picture.
std::vector<uint8_t> encodeJpeg(std::span<const uint8_t> rgb, Size size);

/// A WebP file of 8-bit RGB, with loss, `quality` 1..100; empty where the picture is too large for
/// one, or the library relamp_formats is not there or does not do it. Throws Error(cancelled).
std::vector<uint8_t> encodeWebp(std::span<const uint8_t> rgb, Size size, int quality,
                                const Progress& progress);

/// Writes an EXR of half floats, RGB, linear Rec. 709, losslessly. Throws Error(cannotWrite) with
/// the system's reason.
void writeExr(const std::filesystem::path& file, std::span<const uint16_t> rgb, Size size);

} // namespace relamp
