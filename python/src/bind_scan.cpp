#include "bind.h"
#include "watched.h"

#include "relamp/scan.h"

#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace
{

namespace py = pybind11;
using relamp::Scan;

[[noreturn]] void refuse(const std::string& name, const std::string& wanted, const py::array& given)
{
    throw py::value_error(fmt::format("{} must be {}; it is {} of {}", name, wanted,
                                      py::str(py::tuple(given.attr("shape"))).cast<std::string>(),
                                      py::str(given.dtype()).cast<std::string>()));
}

bool isOfKinds(const py::array& values, const char* kinds)
{
    return std::strchr(kinds, values.dtype().kind()) != nullptr;
}

/// Rows of `Row`, which is as many numbers as its components. `kinds` are NumPy's: f, i, u.
template<class Row, class Number>
std::vector<Row> rowsOf(const py::array& values, const std::string& name, const std::string& wanted,
                        const char* kinds)
{
    constexpr py::ssize_t kComponents = Row::length();
    if (values.ndim() != 2 || values.shape(1) != kComponents || !isOfKinds(values, kinds))
        refuse(name, wanted, values);
    const py::array_t<Number, py::array::c_style | py::array::forcecast> numbers(values);
    std::vector<Row> rows(static_cast<size_t>(numbers.shape(0)));
    if (!rows.empty()) std::memcpy(rows.data(), numbers.data(), rows.size() * sizeof(Row));
    return rows;
}

std::vector<glm::uvec3> trianglesOf(const py::array& values)
{
    const char* wanted = "(T, 3) whole numbers, indices of positions";
    const auto signedRows =
        rowsOf<glm::vec<3, int64_t>, int64_t>(values, "triangles", wanted, "iu");
    std::vector<glm::uvec3> triangles;
    triangles.reserve(signedRows.size());
    for (const auto& corners : signedRows) {
        for (int corner = 0; corner < 3; ++corner)
            if (corners[corner] < 0 || corners[corner] > UINT32_MAX)
                throw py::value_error(
                    fmt::format("triangles: {} is no index of a position", corners[corner]));
        triangles.emplace_back(corners);
    }
    return triangles;
}

/// Bytes are sRGB as in a file; floats are linear light.
relamp::Image imageOf(const py::array& pixels)
{
    const char* wanted = "(H, W, 3), uint8 (sRGB) or floats (linear, 1 = white)";
    const bool isEncoded = pixels.dtype().is(py::dtype::of<uint8_t>());
    if (pixels.ndim() != 3 || pixels.shape(2) != 3 || pixels.size() == 0 ||
        !(isEncoded || isOfKinds(pixels, "f")))
        refuse("texture", wanted, pixels);
    relamp::Image image;
    image.height = static_cast<int>(pixels.shape(0));
    image.width = static_cast<int>(pixels.shape(1));
    if (isEncoded) {
        const py::array_t<uint8_t, py::array::c_style> bytes(pixels);
        image.rgb = std::vector<uint8_t>(bytes.data(), bytes.data() + bytes.size());
        return image;
    }
    const py::module_ numpy = py::module_::import("numpy");
    const py::array finite = numpy.attr("clip")(pixels, 0.0, 65504.0);
    if (!numpy.attr("isfinite")(pixels).attr("all")().cast<bool>())
        throw py::value_error("texture: it holds NaN or infinity; numpy.nan_to_num takes them out");
    const py::array halves = numpy.attr("ascontiguousarray")(finite.attr("astype")("float16"));
    const auto* first = static_cast<const uint16_t*>(halves.data());
    image.transfer = relamp::Transfer::linear;
    image.clipsAtWhite = false;
    image.rgb = std::vector<uint16_t>(first, first + halves.size());
    return image;
}

relamp::ScanOptions optionsOf(const std::string& up, double scale)
{
    if (!(scale >= 1e-6 && scale <= 1e6))
        throw py::value_error(fmt::format("scale={} is not between 1e-06 and 1e+06", scale));
    return {.up = namedBy<relamp::UpAxis>("up", up), .scale = scale};
}

std::shared_ptr<Scan> scanOfArrays(const py::array& positions, const py::array& triangles,
                                   const py::array& uv, const py::array& texture,
                                   const std::string& name, const std::string& up, double scale)
{
    const char* real = "(N, 3) floats";
    const auto points = rowsOf<glm::vec3, float>(positions, "positions", real, "f");
    const auto corners = trianglesOf(triangles);
    const auto coordinates = rowsOf<glm::vec2, float>(uv, "uv", "(N, 2) floats", "f");
    if (coordinates.size() != points.size())
        throw py::value_error(
            fmt::format("uv has {} rows and positions have {}; each position needs one",
                        coordinates.size(), points.size()));
    const relamp::SurfaceArrays surface{
        .name = name, .texture = 0, .positions = points, .triangles = corners, .uvs = coordinates};
    std::vector<relamp::Image> textures;
    textures.push_back(imageOf(texture));
    const relamp::ScanOptions options = optionsOf(up, scale);
    const py::gil_scoped_release others;
    return std::make_shared<Scan>(
        relamp::makeScan(name, {&surface, 1}, std::move(textures), options));
}

std::shared_ptr<Scan> scanOfFile(const std::filesystem::path& file, const std::string& up,
                                 double scale, const std::string& transfer,
                                 std::vector<std::string> skipMesh, bool allowOutside,
                                 bool allowOverlap, int longestSide, const py::object& progress)
{
    relamp::ScanOptions options = optionsOf(up, scale);
    options.transfer = namedBy<relamp::Transfer>("transfer", transfer);
    options.skipMeshes = std::move(skipMesh);
    options.allowOutside = allowOutside;
    options.allowOverlap = allowOverlap;
    if (longestSide < 0)
        throw py::value_error(fmt::format("longest_side={} is less than 0", longestSide));
    options.longestSide = longestSide;
    return watched(progress, 0, [&](relamp::Progress& watch) {
        return std::make_shared<Scan>(relamp::readScan(file, options, watch));
    });
}

std::string describe(const Scan& scan)
{
    return fmt::format("<relamp.Scan {:?}: {} triangles, {} texture page{}>", scan.title(),
                       scan.triangleCount(), scan.pages.size(), scan.pages.size() == 1 ? "" : "s");
}

} // namespace

void bindScan(py::module_& module)
{
    py::class_<Scan, std::shared_ptr<Scan>>(
        module, "Scan",
        "A scanned room: surfaces in metres and the photo texture on them.\n\n"
        "Made of arrays it is held to the same rules as a file. positions: (N, 3) floats, in "
        "units\n"
        "of `scale` metres, `up` ('y' or 'z') to the ceiling; triangles: (T, 3) whole numbers,\n"
        "counter-clockwise seen from the lit side; uv: (N, 2) floats, v downwards; texture:\n"
        "(H, W, 3), uint8 (sRGB) or floats (linear, 1 = white). Nothing given is kept.\n\n"
        "Raises ValueError where an array has another shape or type, relamp.Error where what it\n"
        "holds is no surface.")
        .def(py::init(&scanOfArrays), py::arg("positions"), py::arg("triangles"), py::arg("uv"),
             py::arg("texture"), py::kw_only(), py::arg("name") = "scan", py::arg("up") = "y",
             py::arg("scale") = 1.0)
        .def_readonly("name", &Scan::name, "Of its file, without folder and ending.")
        .def_property_readonly(
            "file", [](const Scan& scan) { return scan.file; },
            "That it was read from; an empty path if it was made of arrays.")
        .def_readonly("warnings", &Scan::warnings,
                      "What was left out or repaired, a sentence each.")
        .def_property_readonly("triangle_count", &Scan::triangleCount, "Triangles of all meshes.")
        .def_property_readonly(
            "page_count", [](const Scan& scan) { return scan.pages.size(); }, "Texture pages.")
        .def("__repr__", &describe);
    module.def("read_scan", &scanOfFile, py::arg("file"), py::kw_only(), py::arg("up") = "y",
               py::arg("scale") = 1.0, py::arg("transfer") = "auto",
               py::arg("skip_mesh") = std::vector<std::string>{}, py::arg("allow_outside") = false,
               py::arg("allow_overlap") = false, py::arg("longest_side") = 0,
               py::arg("progress") = py::none(),
               "Reads glTF, GLB, OBJ, PLY and what else Assimp knows.\n\n"
               "up: the file's axis to the ceiling, 'y' or 'z'; scale: metres a unit of the file;\n"
               "transfer: 'auto', 'srgb' or 'linear'; skip_mesh: names of meshes to leave out;\n"
               "longest_side: pixels, longer textures are halved until they fit, 0: none is;\n"
               "progress: called with a stage's name and its share done, 0..1.\n\n"
               "Raises relamp.Error with a sentence on what is no whole, textured surface.");
}
