#pragma once

#include "relamp/api.h"
#include "relamp/picture.h"
#include "relamp/relight.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace relamp
{

/// Light that changes: lights files as keys in time, and what is between them.
class RELAMP_API Timeline
{
public:
    /// Reads a timeline, described in docs/guide/relighting.md. `warnings` receives a sentence a
    /// key that was passed over. Throws Error(cannotRead | malformed) naming the file, the line and
    /// the key, also where two keys that follow each other do not fit together.
    Timeline(const std::filesystem::path& file, const Lights& captured,
             std::vector<std::string>& warnings);
    ~Timeline();
    Timeline(Timeline&&) noexcept;
    Timeline& operator=(Timeline&&) noexcept;

    /// How long the film is, > 0.
    [[nodiscard]] double seconds() const;

    /// The light at a part of the film, 0..1. Between two keys numbers change evenly, so light adds
    /// up as light does; colour temperatures evenly in mired, which is how people see them; what is
    /// no number stays until the next key.
    [[nodiscard]] Relighting at(double part) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

struct Film
{
    Camera camera;
    PictureOptions picture;
    int frames = 0;                     // 1..9999
    bool turns = false;                 // the camera, once in all frames; see `turned`
    const Timeline* timeline = nullptr; // of the light; null: it stays as it was set
    double framesPerSecond = 24.0;      // of a video, 1..240
};

/// Writes a film: a video through the program ffmpeg where `target` ends in .mp4, else a folder of
/// frame_0001.png and so on, in which no frame of a longer film stays. Whole or not at all. Throws
/// Error(cannotWrite | cancelled); the former where ffmpeg is not there or does not do its work.
RELAMP_API void writeFilm(Relighter& relighter, const Photographer& photographer, const Film& film,
                          const std::filesystem::path& target, Progress& progress);

} // namespace relamp
