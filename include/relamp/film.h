#pragma once

#include "relamp/api.h"
#include "relamp/picture.h"
#include "relamp/relight.h"
#include "relamp/replacing.h"
#include "relamp/timeline.h"

#include <filesystem>

namespace relamp
{

struct Film
{
    Camera camera;
    PictureOptions picture;
    int frames = 0;                             // 1..9999
    bool turns = false;                         // the camera, once in all frames; see `turned`
    const Timeline* timeline = nullptr;         // of the light; null: it stays as it was set
    double framesPerSecond = 24.0;              // of a video, 1..240
    Replacing replacing = Replacing::unchanged; // in a folder
};

/// Frames of a film as long as the timeline, 1..9999.
RELAMP_API int framesOf(const Timeline& timeline, double framesPerSecond);

/// Whether a film of this name is a video: its name ends in .mp4. Else it is a folder of pictures:
/// a name without an ending or with a slash behind it, or a folder that is there. Throws
/// Error(unsupported) where it is neither.
RELAMP_API bool isVideo(const std::filesystem::path& target);

/// Throws Error(cannotWrite | unsupported) where writeFilm could not write `target`: no ffmpeg for
/// a video, odd sizes, no permission, a folder whose frames it may not replace. Worth asking before
/// work that takes long.
RELAMP_API void checkFilm(const Film& film, const std::filesystem::path& target);

/// Stops for `film.picture.view` at which the film as a whole is well exposed, so that it does not
/// flicker: Photographer::automaticExposure over frames that are spread evenly over it. Sets the
/// light where the film has a timeline. Throws Error(cancelled).
RELAMP_API float automaticExposure(Relighter& relighter, const Photographer& photographer,
                                   const Film& film, Progress& progress = unwatched());

/// Writes a film: a video through the program ffmpeg where `isVideo(target)`, else a folder of
/// frame_0001.png and so on with a list of them, film.json, in which no frame of a longer film
/// stays. Whole or not at all. Throws
/// Error(cannotWrite | unsupported | cancelled); the first where ffmpeg is not there or does not do
/// its work. `progress` is told of "frame 3 of 192" as a part.
RELAMP_API void writeFilm(Relighter& relighter, const Photographer& photographer, const Film& film,
                          const std::filesystem::path& target, Progress& progress = unwatched());

} // namespace relamp
