#pragma once

#include "image/picture.h"

#include <cstddef>
#include <span>
#include <string>

namespace relamp
{

/// Reads what OpenImageIO can; `format` is its name of a format. OpenImageIO brings 250 libraries
/// with it, a quarter of a second of loading: that is done when the first such picture is read.
/// Throws UndecodablePicture, and Error(unsupported) where the library relamp_formats is not there.
Picture readOtherFormat(std::span<const std::byte> bytes, const std::string& format,
                        const HeaderCheck& check);

/// What relamp_formats offers as kReadWithOpenImageIo. A failure comes as text.
struct OtherFormat
{
    std::span<const std::byte> bytes;
    const std::string& format;
    const HeaderCheck& check;
    int threads;
    Picture picture;
    std::string failure; // empty: none
};
using ReadWithOpenImageIo = void(OtherFormat& file);
constexpr const char* kReadWithOpenImageIo = "relampReadWithOpenImageIo";

} // namespace relamp
