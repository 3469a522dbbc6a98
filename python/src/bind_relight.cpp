#include "arrays.h"
#include "bind.h"
#include "camera_arguments.h"
#include "lighter.h"
#include "watched.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace
{

namespace py = pybind11;

/// A room under one light.
struct Relit
{
    std::shared_ptr<Lighter> lighter;
    relamp::Relighting light;
    std::vector<relamp::Image> pages;
    std::vector<std::string> warnings;
};

std::shared_ptr<Lighter> lighterOf(const relamp::Decomposition& room, int threads,
                                   const py::object& progress)
{
    return watched(progress, threads,
                   [&](relamp::Progress& watch) { return std::make_shared<Lighter>(room, watch); });
}

std::shared_ptr<Relit> relight(const std::shared_ptr<Lighter>& lighter, const std::string& text,
                               const std::filesystem::path& file,
                               const std::vector<std::string>& settings, int threads,
                               const py::object& progress)
{
    const auto relit = std::make_shared<Relit>();
    relit->lighter = lighter;
    relit->light = lightOf(lighter->room.captured, text, file, settings, relit->warnings);
    relit->pages = watched(progress, threads, [&](relamp::Progress& watch) {
        return lighter->under(relit->light, relit->warnings, watch,
                              [&](const relamp::Relighter& relighter) {
                                  return relamp::radianceOfPages(relighter, watch);
                              });
    });
    return relit;
}

py::array radianceOf(const std::shared_ptr<Relit>& relit, size_t page)
{
    const relamp::Image& image = relit->pages.at(page);
    return viewOf(image.half(), "float16", image.width, image.height, relit);
}

/// `exposure`: stops; None: so that the log-average is middle grey. `linear`: the light itself.
py::array pictureOf(const Relit& relit, const std::optional<CameraArguments>& given,
                    std::pair<int, int> size, const std::string& view,
                    std::optional<float> exposure, int antialias, bool linear, int threads,
                    const py::object& progress)
{
    const relamp::Photographer& photographer = relit.lighter->photographer;
    const relamp::Camera camera = given ? cameraOf(*given) : photographer.goodView();
    relamp::PictureOptions options{.width = size.first,
                                   .height = size.second,
                                   .samples = antialias,
                                   .view = {.view = namedBy<relamp::View>("view", view)},
                                   .sky = relit.light.sky,
                                   .lamps = relit.light.lights};
    if (linear) {
        const auto image = std::make_shared<const relamp::Image>(
            watched(progress, threads, [&](relamp::Progress& watch) {
                return photographer.take(relit.pages, camera, options, watch);
            }));
        return viewOf(image->half(), "float16", image->width, image->height, image);
    }
    const auto bytes = std::make_shared<const std::vector<uint8_t>>(
        watched(progress, threads, [&](relamp::Progress& watch) {
            options.view.exposure =
                exposure ? *exposure
                         : photographer.automaticExposure(relit.pages, camera, options, watch);
            return photographer.develop(relit.pages, camera, options, watch);
        }));
    return viewOf(*bytes, "uint8", size.first, size.second, bytes);
}

} // namespace

void bindRelight(py::module_& module)
{
    py::class_<Lighter, std::shared_ptr<Lighter>>(module, "Lighter",
                                                  "A room for one light after the other.")
        .def(py::init(&lighterOf), py::arg("room"), py::arg("threads"), py::arg("progress"))
        .def("relight", &relight, py::arg("text"), py::arg("file"), py::arg("settings"),
             py::arg("threads"), py::arg("progress"));
    py::class_<Relit, std::shared_ptr<Relit>>(module, "Relit", "A room under one light.")
        .def_readonly("warnings", &Relit::warnings)
        .def("radiance", &radianceOf, py::arg("page"))
        .def("picture", &pictureOf, py::arg("camera"), py::arg("size"), py::arg("view"),
             py::arg("exposure"), py::arg("antialias"), py::arg("linear"), py::arg("threads"),
             py::arg("progress"));
}
