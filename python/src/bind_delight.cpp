#include "arrays.h"
#include "bind.h"
#include "watched.h"

#include "relamp/delight.h"
#include "relamp/response.h"
#include "relamp/result.h"

#include <array>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace
{

namespace py = pybind11;
using relamp::Decomposition;

py::dict layersOf(const Decomposition& room, size_t page, int threads, const py::object& progress)
{
    using namespace py::literals;
    const auto layers = std::make_shared<const relamp::PageLayers>(watched(
        progress, threads, [&](relamp::Progress& watch) { return room.layers(page, watch); }));
    const auto view = [&](const auto& values, const char* type) {
        return viewOf(values, type, layers->width, layers->height, layers);
    };
    return py::dict("albedo"_a = view(layers->albedo, "float16"),
                    "direct"_a = view(layers->direct, "float16"),
                    "indirect"_a = view(layers->indirect, "float16"),
                    "confidence"_a = view(layers->confidence, "uint8"),
                    "doubt"_a = view(layers->doubt, "uint8"));
}

py::array fixtureMapOf(const Decomposition& room, size_t page, int threads)
{
    const auto map = std::make_shared<const relamp::FixtureMap>(
        watched(py::none(), threads, [&](relamp::Progress&) { return room.fixtures(page); }));
    return viewOf(map->id, "int32", map->width, map->height, map);
}

/// None where the solver corrected nothing.
py::object correctionOf(const Decomposition& room, size_t page, int threads)
{
    const auto map = std::make_shared<const relamp::CorrectionMap>(
        watched(py::none(), threads, [&](relamp::Progress&) { return room.correction(page); }));
    if (map->isEmpty()) return py::none();
    return viewOf(map->share, "uint8", map->width, map->height, map);
}

py::tuple geometryOf(const Decomposition& room, size_t page, int threads)
{
    const auto geometry = std::make_shared<const relamp::PageGeometry>(
        watched(py::none(), threads, [&](relamp::Progress&) { return room.geometry(page); }));
    const auto view = [&](const std::vector<float>& values) {
        return viewOf(values, "float32", geometry->width, geometry->height, geometry);
    };
    return py::make_tuple(view(geometry->positions), view(geometry->normals));
}

std::filesystem::path sourceOf(const relamp::Scan& scan)
{
    return scan.file.empty() ? std::filesystem::path(scan.name + ".glb") : scan.file;
}

std::string save(const Decomposition& room, const std::filesystem::path& folder, bool force,
                 bool usd, int threads, const py::object& progress)
{
    const auto replacing = force ? relamp::Replacing::any : relamp::Replacing::unchanged;
    return watched(progress, threads, [&](relamp::Progress& watch) {
        return relamp::writeResult(room, sourceOf(*room.scan()), folder, watch, replacing,
                                   {.usd = usd});
    });
}

py::dict crossValidationOf(const Decomposition& room)
{
    using namespace py::literals;
    const relamp::CrossValidation& validation = room.crossValidation();
    return py::dict("pairs"_a = validation.pairs, "scan"_a = validation.scan,
                    "albedo"_a = validation.albedo, "gain"_a = validation.gain(),
                    "improves"_a = validation.improves);
}

py::list openingsOf(const Decomposition& room)
{
    using namespace py::literals;
    py::list openings;
    for (const relamp::Opening& opening : room.openings())
        openings.append(py::dict("centre"_a = tupleOf(opening.centre),
                                 "normal"_a = tupleOf(opening.normal), "area"_a = opening.area,
                                 "radiance"_a = tupleOf(opening.radiance)));
    return openings;
}

py::dict cameraModelOf(const Decomposition& room)
{
    using namespace py::literals;
    const relamp::CameraModel& camera = room.lights().camera;
    return py::dict("contrast"_a = camera.response.contrast(),
                    "response"_a = py::tuple(py::cast(camera.response.slope)),
                    "local_exponent"_a = camera.tone.exponent, "gain_stops"_a = camera.stops(),
                    "drifted"_a = camera.drifted);
}

/// All that the program says of a scan and of what came of it.
std::vector<std::string> warningsOf(const Decomposition& room)
{
    std::vector<std::string> warnings = room.scan()->warnings;
    const std::vector<std::string> ofResult = room.warnings();
    warnings.insert(warnings.end(), ofResult.begin(), ofResult.end());
    return warnings;
}

int within(const char* keyword, int value, int low, int high)
{
    if (value >= low && value <= high) return value;
    throw py::value_error(fmt::format("{}={} is not between {} and {}", keyword, value, low, high));
}

/// 0: left to the solver.
int withinOrNone(const char* keyword, int value, int low, int high)
{
    return value == 0 ? 0 : within(keyword, value, low, high);
}

/// The parameters of the thesis solver that were given; the others stay as they are.
relamp::ThesisOptions thesisOf(const py::dict& given)
{
    relamp::ThesisOptions thesis;
    const auto set = [&given](const char* keyword, auto& value, auto low, auto high) {
        using Value = std::remove_pointer_t<decltype(&low)>;
        if (!given.contains(keyword)) return;
        const auto number = given[keyword].cast<Value>();
        if (!(number >= low && number <= high))
            throw py::value_error(
                fmt::format("{}={} is not between {} and {}", keyword, number, low, high));
        value = number;
    };
    set("emitter_threshold", thesis.emitterThreshold, 0.0f, 1.0f);
    set("expansion", thesis.expansion, 1.0f, 1e4f);
    set("light_levels", thesis.lightLevels, 0, 10);
    set("power", thesis.power, 1e-6f, 1e6f);
    set("ambient", thesis.ambient, 0.0f, 1e6f);
    set("merge_distance", thesis.mergeDistance, 0.0f, 1e6f);
    set("rsm_size", thesis.rsmSize, 8, 512);
    set("lpv_size", thesis.lpvSize, 8, 128);
    set("lpv_steps", thesis.lpvSteps, 1, 128);
    set("flatten_reach", thesis.flattenReach, 1.0f, 2.0f);
    set("flatten_range", thesis.flattenRange, 0.01f, 10.0f);
    if (given.contains("attenuation")) {
        const auto k = given["attenuation"].cast<std::array<float, 3>>();
        for (const float factor : k)
            if (!(factor >= 0.0f && factor <= 1e6f))
                throw py::value_error(
                    fmt::format("attenuation: {} is not between 0 and 1000000", factor));
        thesis.attenuation = glm::vec3(k[0], k[1], k[2]);
    }
    if (given.contains("no_lpv")) thesis.useLpv = !given["no_lpv"].cast<bool>();
    if (given.contains("no_ambient")) thesis.useAmbient = !given["no_ambient"].cast<bool>();
    return thesis;
}

/// The keywords of delight() in relamp/delight.py, which names the default of each once.
relamp::DelightOptions optionsOf(const py::dict& given)
{
    const auto get = [&given](const char* keyword) { return given[keyword]; };
    const auto places = [&](const char* keyword) {
        std::vector<glm::vec3> points;
        for (const auto& [x, y, z] :
             get(keyword).cast<std::vector<std::tuple<float, float, float>>>())
            points.emplace_back(x, y, z);
        return points;
    };
    relamp::DelightOptions options;
    options.solver = namedBy<relamp::Solver>("solver", get("solver").cast<std::string>());
    relamp::GatherOptions& gather = options.gather;
    gather.quality = namedBy<relamp::Quality>("quality", get("quality").cast<std::string>());
    gather.rays = withinOrNone("rays", get("rays").cast<int>(), 4, 1024);
    gather.shadowRays = withinOrNone("shadow_rays", get("shadow_rays").cast<int>(), 1, 1024);
    gather.lights = places("light");
    gather.notLights = places("not_a_light");
    const std::vector<glm::vec3> ends = places("same");
    for (size_t i = 0; i + 1 < ends.size(); i += 2) gather.same.push_back({ends[i], ends[i + 1]});
    gather.white = places("white");
    gather.sun = !get("no_sun").cast<bool>();
    gather.gain = !get("no_gain").cast<bool>();
    gather.seed = options.pathtrace.seed = get("seed").cast<uint32_t>();
    options.pathtrace.samples = within("samples", get("samples").cast<int>(), 1, 65536);
    options.thesis = thesisOf(get("thesis"));
    options.albedo.darkest = get("darkest").cast<float>();
    options.albedo.fill = get("fill").cast<bool>();
    options.engine.engine = namedBy<relamp::Engine>("engine", get("engine").cast<std::string>());
    options.engine.gpu = get("gpu").cast<std::string>();
    return options;
}

/// What relamp delight does between reading a scan and writing its result, in its order.
std::pair<std::shared_ptr<Decomposition>, std::vector<std::string>>
delight(const std::shared_ptr<relamp::Scan>& scan, relamp::DelightOptions options,
        const std::filesystem::path& lights, const std::filesystem::path& response, int threads,
        const py::object& progress)
{
    std::vector<std::string> notes;
    auto room = watched(progress, threads, [&](relamp::Progress& watch) {
        relamp::checkDevice(options.engine);
        if (!lights.empty()) {
            options.lights = relamp::readLights(lights, notes);
            options.fixtures = relamp::readFixturesBeside(lights, scan->file, *scan);
        }
        if (response == "straight")
            options.gather.response = relamp::Response{};
        else if (!response.empty())
            options.gather.response = relamp::readResponse(response, notes);
        if (options.gather.quality == relamp::Quality::draft)
            return std::make_shared<Decomposition>(
                relamp::delight(relamp::coarsened(*scan, relamp::kDraftSide), options, watch));
        return std::make_shared<Decomposition>(
            relamp::delight(std::shared_ptr<const relamp::Scan>(scan), options, watch));
    });
    return {std::move(room), std::move(notes)};
}

} // namespace

void bindDelight(py::module_& module)
{
    py::class_<Decomposition, std::shared_ptr<Decomposition>>(
        module, "Decomposition", "A room taken apart. relamp.Room is what people hold.")
        .def_property_readonly("lights", &Decomposition::lights,
                               py::return_value_policy::reference_internal)
        .def_property_readonly("page_count",
                               [](const Decomposition& room) { return room.scan()->pages.size(); })
        .def_property_readonly("name",
                               [](const Decomposition& room) { return room.scan()->title(); })
        .def_property_readonly("warnings", &warningsOf)
        .def_property_readonly("cross_validation", &crossValidationOf)
        .def_property_readonly("openings", &openingsOf)
        .def_property_readonly("camera", &cameraModelOf)
        .def("layers", &layersOf, py::arg("page"), py::arg("threads"), py::arg("progress"))
        .def("fixtures", &fixtureMapOf, py::arg("page"), py::arg("threads"))
        .def("correction", &correctionOf, py::arg("page"), py::arg("threads"))
        .def("geometry", &geometryOf, py::arg("page"), py::arg("threads"))
        .def("save", &save, py::arg("folder"), py::arg("force"), py::arg("usd"), py::arg("threads"),
             py::arg("progress"));
    py::list doubts;
    for (const char* name : relamp::Names<relamp::Doubt>::all) doubts.append(name);
    module.attr("DOUBTS") = py::tuple(doubts);
    module.attr("ALL_LIGHT") = relamp::CorrectionMap::kAll;
    py::class_<relamp::DelightOptions>(module, "Options", "The keywords of delight(), checked.")
        .def(py::init(&optionsOf), py::arg("given"));
    module.def("delight", &delight, py::arg("scan"), py::arg("options"), py::arg("lights"),
               py::arg("response"), py::arg("threads"), py::arg("progress"));
}
