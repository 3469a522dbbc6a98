#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace relamp::scenes
{

/// Pixels of a picture, row after row; whole numbers fill their range, floats are 0..1 and beyond.
template<class Sample>
struct Pixels
{
    int width = 0;
    int height = 0;
    int channels = 3;
    std::vector<Sample> samples;
};

/// A picture file: "png", "jpeg", "webp", "tiff", "openexr", "hdr", "bmp" or "targa". A JPEG keeps
/// colour at the resolution that `subsampling` says; an EXR or a TIFF may keep the samples as
/// another type, "half".
template<class Sample>
std::vector<uint8_t> pictureFile(const std::string& format, const Pixels<Sample>& pixels,
                                 const std::string& subsampling = "4:4:4",
                                 const std::string& fileType = "");

/// Two by two: red, green, then blue, white.
Pixels<uint8_t> fourColors();

/// The four colours as a PNG of one byte a pixel into a palette.
std::vector<uint8_t> palettePng();

/// A PNG whose header is right in form and claims that size, and whose data is that of the four
/// colours.
std::vector<uint8_t> pngClaiming(uint32_t width, uint32_t height);

} // namespace relamp::scenes
