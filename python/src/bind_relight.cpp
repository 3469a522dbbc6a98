#include "arrays.h"
#include "bind.h"
#include "watched.h"

#include "relamp/picture.h"
#include "relamp/relight.h"

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace
{

namespace py = pybind11;

/// A room and what rays found of it, for one light after the other.
class Lighter
{
public:
    Lighter(const relamp::Decomposition& decomposition, relamp::Progress& progress)
        : room(relamp::delitRoomOf(decomposition, progress)), relighter_(room, {}, progress),
          photographer(relighter_)
    {}

    /// `warnings` receives what is doubtful of the light.
    std::vector<relamp::Image> radiance(const relamp::Relighting& light,
                                        std::vector<std::string>& warnings,
                                        relamp::Progress& progress)
    {
        const std::scoped_lock one(mutex_);
        relighter_.light(light, progress);
        warnings.insert(warnings.end(), relighter_.warnings().begin(), relighter_.warnings().end());
        return relamp::radianceOfPages(relighter_, progress);
    }

    const relamp::DelitRoom room;

private:
    std::mutex mutex_;
    relamp::Relighter relighter_;

public:
    const relamp::Photographer photographer;
};

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

/// `text` is that of a lights file, and `file` where it lies; empty: all is dark but for what
/// `settings` turn on.
std::shared_ptr<Relit> relight(const std::shared_ptr<Lighter>& lighter, const std::string& text,
                               const std::filesystem::path& file,
                               const std::vector<std::string>& settings, int threads,
                               const py::object& progress)
{
    const auto relit = std::make_shared<Relit>();
    relit->lighter = lighter;
    const relamp::Lights& captured = lighter->room.captured;
    relit->light = text.empty()
                       ? relamp::darkened(captured)
                       : relamp::RelightingReader().read(text, file, captured, relit->warnings);
    for (const std::string& setting : settings) relamp::setFixture(relit->light, captured, setting);
    relit->pages = watched(progress, threads, [&](relamp::Progress& watch) {
        return lighter->radiance(relit->light, relit->warnings, watch);
    });
    return relit;
}

py::array radianceOf(const std::shared_ptr<Relit>& relit, size_t page)
{
    const relamp::Image& image = relit->pages.at(page);
    return viewOf(image.half(), "float16", image.width, image.height, relit);
}

using CameraArguments = std::tuple<std::tuple<float, float, float>, std::tuple<float, float, float>,
                                   std::tuple<float, float, float>, float>;

relamp::Camera cameraOf(const CameraArguments& given)
{
    const auto vectorOf = [](const std::tuple<float, float, float>& v) {
        return glm::vec3(std::get<0>(v), std::get<1>(v), std::get<2>(v));
    };
    return {.position = vectorOf(std::get<0>(given)),
            .forward = vectorOf(std::get<1>(given)),
            .up = vectorOf(std::get<2>(given)),
            .fieldOfView = std::get<3>(given)};
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
