#pragma once

#include "relamp/api.h"
#include "relamp/picture.h"
#include "relamp/relight.h"
#include "relamp/timeline.h"

#include <filesystem>

namespace relamp
{

struct Film
{
    Camera camera;
    PictureOptions picture;
    int frames = 0;                     // 1..9999
    bool turns = false;                 // the camera, once in all frames; see `turned`
    const Timeline* timeline = nullptr; // of the light; null: it stays as it was set
    double framesPerSecond = 24.0;      // of a video, 1..240
};

/// Throws Error(cannotWrite) where writeFilm could not write `target`: no ffmpeg for a video, odd
/// sizes, no permission. Worth asking before work that takes long.
RELAMP_API void checkFilm(const Film& film, const std::filesystem::path& target);

/// Writes a film: a video through the program ffmpeg where `target` ends in .mp4, else a folder of
/// frame_0001.png and so on, in which no frame of a longer film stays. Whole or not at all. Throws
/// Error(cannotWrite | cancelled); the former where ffmpeg is not there or does not do its work.
RELAMP_API void writeFilm(Relighter& relighter, const Photographer& photographer, const Film& film,
                          const std::filesystem::path& target, Progress& progress);

} // namespace relamp
