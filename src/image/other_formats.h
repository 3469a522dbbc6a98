#pragma once

#include "base/child_process.h"
#include "image/picture.h"

#include <cstdint>
#include <span>
#include <string>

namespace relamp
{

/// Reads what OpenImageIO can, in a child process: of a dozen libraries for formats that few scans
/// come in, some crash on broken files, hang, or make room for whatever a header claims.
///
/// `mostBytes` is what the samples may take up; memory and time of the child are cut to it. `check`
/// is asked as soon as there is a header, in the child, and again in this process.
/// Throws Error(malformed), and Error(unsupported) where the library relamp_formats is not there.
/// That brings 250 libraries with it, a quarter of a second of loading: it is done when the first
/// such picture is read.
Picture readOtherFormat(const PictureFile& file, int64_t mostBytes, const HeaderCheck& check);

/// What relamp_formats offers as kReadWithOpenImageIo. A failure comes as text.
struct OtherFormat
{
    const PictureFile& file;
    int threads;
    int exrThreads;
    HeaderCheck takeHeader;
    ByteSink takeSamples; // some rows at a time, as Picture has them
    std::string failure;  // empty: none
};
using ReadWithOpenImageIo = void(OtherFormat& file);
constexpr const char* kReadWithOpenImageIo = "relampReadWithOpenImageIo";

/// A picture that relamp_formats is to write, as kWriteWithOpenImageIo.
struct WebpFile
{
    std::span<const uint8_t> rgb;
    int width;
    int height;
    int quality;         // 1..100
    ByteSink take;       // the file
    std::string failure; // empty: none
};
using WriteWithOpenImageIo = void(WebpFile& file);
constexpr const char* kWriteWithOpenImageIo = "relampWriteWithOpenImageIo";

} // namespace relamp
