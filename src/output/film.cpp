#include "relamp/film.h"

#include "base/fail.h"
#include "base/file.h"
#include "image/light_meter.h"
#include "output/listed_folder.h"
#include "output/small_picture.h"
#include "output/video_file.h"
#include "relamp/printable.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

namespace relamp
{
namespace
{

constexpr const char* kFilmList =
    "film.json"; // of a folder's frames, by which the next film knows them

/// Calls `take(frame)` for one after the other; what it gives is sRGB.
using TakeFrame = std::function<std::vector<uint8_t>(int frame)>;

Size sizeOf(const Film& film)
{
    return {film.picture.width, film.picture.height};
}

std::string nameOfFrame(int frame)
{
    return fmt::format("frame_{:04}.png", frame + 1);
}

bool isFrame(const std::string& name)
{
    return name.size() == nameOfFrame(0).size() && name.starts_with("frame_") &&
           name.ends_with(".png") && std::all_of(name.begin() + 6, name.begin() + 10, [](char c) {
               return c >= '0' && c <= '9';
           });
}

FolderRules rulesOf(const Film& film)
{
    return {kFilmList, [](const std::string& name) { return name == kFilmList || isFrame(name); },
            film.replacing};
}

void writeFolder(const std::filesystem::path& folder, const Film& film, const TakeFrame& take,
                 Progress& progress)
{
    ListedFolder files(folder, rulesOf(film), progress);
    for (int frame = 0; frame < film.frames; ++frame) {
        const auto png = encodePng(take(frame), sizeOf(film), 3);
        writeFile(files / nameOfFrame(frame), std::as_bytes(std::span(png)));
    }
    files.commit(nlohmann::ordered_json::object());
}

void writeVideo(const std::filesystem::path& file, const Film& film, const TakeFrame& take,
                Progress& progress)
{
    VideoFile video(file, sizeOf(film), film.framesPerSecond, progress);
    for (int frame = 0; frame < film.frames; ++frame) video.add(take(frame));
    progress.check();
    video.commit();
}

/// Takes the frames of a film, in any order: sets the light, and turns the camera.
class FrameTaker
{
public:
    FrameTaker(Relighter& relighter, const Photographer& photographer, const Film& film,
               Progress& progress)
        : relighter_(relighter), photographer_(photographer), film_(film), progress_(progress),
          picture_(film.picture)
    {}

    /// For people: sRGB.
    std::vector<uint8_t> developed(int frame)
    {
        light(frame);
        return photographer_.develop(pages_, cameraAt(frame), picture_, progress_);
    }

    /// For a light meter: small, linear half RGB.
    Image measured(int frame)
    {
        light(frame);
        return photographer_.take(pages_, cameraAt(frame), smallPicture(picture_), progress_);
    }

private:
    void light(int frame)
    {
        if (film_.timeline == nullptr && !pages_.empty()) return;
        if (film_.timeline != nullptr) {
            const auto last = static_cast<double>(std::max(film_.frames - 1, 1));
            const Relighting lighting = film_.timeline->at(frame / last);
            relighter_.light(lighting, progress_);
            picture_.sky = lighting.sky;
            picture_.lamps = lighting.lights;
        }
        pages_ = radianceOfPages(relighter_, progress_);
    }

    [[nodiscard]] Camera cameraAt(int frame) const
    {
        if (!film_.turns) return film_.camera;
        return turned(film_.camera, *relighter_.room().scan,
                      static_cast<double>(frame) / film_.frames);
    }

    Relighter& relighter_;
    const Photographer& photographer_;
    const Film& film_;
    Progress& progress_;
    PictureOptions picture_;
    std::vector<Image> pages_;
};

constexpr int kMeasured = 12; // frames of a film

} // namespace

int framesOf(const Timeline& timeline, double framesPerSecond)
{
    return static_cast<int>(
        std::lround(std::clamp(timeline.seconds() * framesPerSecond, 1.0, 9999.0)));
}

bool isVideo(const std::filesystem::path& target)
{
    const std::filesystem::path ending = target.extension();
    std::error_code ignored;
    if (ending.empty() || std::filesystem::is_directory(target, ignored)) return false;
    if (ending != ".mp4")
        fail(ErrorCode::unsupported, target.string(),
             fmt::format("a film ends in .mp4 or is a folder of pictures; {} is not known. Let the "
                         "name end in .mp4, or say {}/ for a folder of that name",
                         printableName(ending.string()), target.string()));
    return true;
}

void checkFilm(const Film& film, const std::filesystem::path& target)
{
    if (!isVideo(target)) return checkListedFolder(target, rulesOf(film));
    Progress nobody;
    const VideoFile trial(target, sizeOf(film), film.framesPerSecond, nobody);
}

float automaticExposure(Relighter& relighter, const Photographer& photographer, const Film& film,
                        Progress& progress)
{
    const int measured = std::min(film.frames, kMeasured);
    const Progress::Stage stage(progress, "expose");
    FrameTaker taker(relighter, photographer, film, progress);
    LightMeter meter;
    for (int i = 0; i < measured; ++i) {
        const int frame = measured == 1 ? 0 : i * (film.frames - 1) / (measured - 1);
        meter.add(taker.measured(frame));
    }
    return meter.exposure();
}

void writeFilm(Relighter& relighter, const Photographer& photographer, const Film& film,
               const std::filesystem::path& target, Progress& progress)
{
    Progress::Stage stage(progress, "film", static_cast<size_t>(film.frames));
    FrameTaker taker(relighter, photographer, film, progress);
    const auto take = [&](int frame) {
        progress.setPart(fmt::format("frame {} of {}", frame + 1, film.frames));
        auto rgb = taker.developed(frame);
        stage.advance();
        return rgb;
    };
    if (isVideo(target))
        writeVideo(target, film, take, progress);
    else
        writeFolder(target, film, take, progress);
    progress.setPart({});
}

} // namespace relamp
