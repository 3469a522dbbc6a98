#pragma once

#include "image/write_image.h"
#include "output/staged_file.h"
#include "relamp/progress.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>

#include <sys/types.h>

namespace relamp
{

/// A video file, H.264 in MP4, made by the program ffmpeg; there when it is complete, or not at
/// all.
class VideoFile
{
public:
    /// Width and height of `size` must be even. Throws Error(cannotWrite) where they are not, where
    /// ffmpeg is not installed, or as StagedFile does.
    VideoFile(const std::filesystem::path& file, Size size, double framesPerSecond,
              Progress& progress);
    ~VideoFile();
    VideoFile(const VideoFile&) = delete;
    VideoFile& operator=(const VideoFile&) = delete;

    /// The next frame: sRGB, three bytes a pixel. Throws Error(cannotWrite) with ffmpeg's reason
    /// where it has given up.
    void add(std::span<const uint8_t> rgb);

    /// Ends the video and puts it in its place.
    void commit();

private:
    void start(Size size, double framesPerSecond);
    void closeInput();
    [[noreturn]] void failWithReason();

    std::filesystem::path file_;
    StagedFile staged_;
    std::FILE* complaints_; // what ffmpeg says
    int input_ = -1;
    pid_t ffmpeg_ = -1;
};

} // namespace relamp
