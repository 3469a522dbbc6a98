#include "bind.h"
#include "camera_arguments.h"
#include "lighter.h"
#include "watched.h"

#include "relamp/film.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace
{

namespace py = pybind11;

/// What Room.film() in relamp/room.py was given, but for the light.
struct FilmArguments
{
    relamp::Film film;
    std::optional<relamp::Camera> camera; // none: the photographer chooses
    std::optional<float> exposure;        // stops; none: that of the film as a whole
};

FilmArguments argumentsOf(const std::optional<CameraArguments>& camera, std::pair<int, int> size,
                          const std::string& view, std::optional<float> exposure, int antialias,
                          int turntable, double fps, bool force)
{
    FilmArguments arguments;
    if (camera) arguments.camera = cameraOf(*camera);
    arguments.exposure = exposure;
    relamp::Film& film = arguments.film;
    film.picture = {.width = size.first,
                    .height = size.second,
                    .samples = antialias,
                    .view = {.view = namedBy<relamp::View>("view", view)}};
    film.turns = turntable > 0;
    film.frames = turntable;
    film.framesPerSecond = fps;
    if (force) film.replacing = relamp::Replacing::any;
    return arguments;
}

/// What `relamp relight` does for a film. Gives sentences on what was passed over or is doubtful.
std::vector<std::string> writeFilm(const std::shared_ptr<Lighter>& lighter,
                                   const std::filesystem::path& target, const std::string& text,
                                   const std::filesystem::path& file,
                                   const std::vector<std::string>& settings,
                                   const std::filesystem::path& timeline, FilmArguments arguments,
                                   int threads, const py::object& progress)
{
    std::vector<std::string> notes;
    const relamp::Lights& captured = lighter->room.captured;
    const relamp::Relighting light = lightOf(captured, text, file, settings, notes);
    relamp::Film& film = arguments.film;
    std::optional<relamp::Timeline> changes;
    if (!timeline.empty()) changes.emplace(timeline, captured, notes);
    film.timeline = changes ? &*changes : nullptr;
    if (changes && !film.turns) film.frames = relamp::framesOf(*changes, film.framesPerSecond);
    film.picture.sky = light.sky;
    film.picture.lamps = light.lights;
    relamp::checkFilm(film, target);
    runWatched(progress, threads, [&](relamp::Progress& watch) {
        const relamp::Photographer& photographer = lighter->photographer;
        film.camera = arguments.camera ? *arguments.camera
                      : film.turns     ? photographer.goodPlaceToTurn()
                                       : photographer.goodView();
        lighter->under(light, notes, watch, [&](relamp::Relighter& relighter) {
            film.picture.view.exposure =
                arguments.exposure
                    ? *arguments.exposure
                    : relamp::automaticExposure(relighter, photographer, film, watch);
            relamp::writeFilm(relighter, photographer, film, target, watch);
        });
    });
    return notes;
}

} // namespace

void bindFilm(py::module_& module)
{
    py::class_<FilmArguments>(module, "FilmArguments", "Keywords of Room.film(), checked.")
        .def(py::init(&argumentsOf), py::arg("camera"), py::arg("size"), py::arg("view"),
             py::arg("exposure"), py::arg("antialias"), py::arg("turntable"), py::arg("fps"),
             py::arg("force"));
    module.def("write_film", &writeFilm, py::arg("lighter"), py::arg("target"), py::arg("text"),
               py::arg("file"), py::arg("settings"), py::arg("timeline"), py::arg("arguments"),
               py::arg("threads"), py::arg("progress"));
}
