#include "bind.h"
#include "watched.h"

#include "relamp/estimate.h"
#include "relamp/inspect.h"

#include <memory>

namespace
{

namespace py = pybind11;
using namespace py::literals;

py::list pagesOf(const relamp::Inspection& found)
{
    py::list pages;
    for (const relamp::PageInspection& page : found.pages)
        pages.append(py::dict("name"_a = page.name, "width"_a = page.width,
                              "height"_a = page.height, "of_vertices"_a = page.ofVertices,
                              "coverage"_a = page.coverage, "clipped"_a = page.clipped,
                              "charts"_a = page.charts));
    return pages;
}

/// Of delight, as far as it can be told before lamps are looked for.
py::dict costOf(const relamp::Inspection& found)
{
    const relamp::Cost cost = relamp::estimate(found, 0).delight;
    return py::dict("bytes"_a = cost.bytes, "core_seconds"_a = cost.coreSeconds);
}

/// What relamp/inspection.py makes an Inspection of: its arguments by name.
py::dict inspect(const std::shared_ptr<const relamp::Scan>& scan, int threads,
                 const py::object& progress)
{
    const relamp::Inspection found = watched(
        progress, threads, [&](relamp::Progress& watch) { return relamp::inspect(*scan, watch); });
    return py::dict("triangles"_a = found.triangles, "meshes"_a = found.meshes,
                    "texels"_a = found.texels, "square_metres"_a = found.squareMetres,
                    "millimetres_per_texel"_a = found.millimetresPerTexel,
                    "extent"_a = tupleOf(found.bounds.extent()),
                    "overlap"_a = found.overlap.share(), "pages"_a = pagesOf(found),
                    "cost"_a = costOf(found), "problems"_a = found.problems);
}

} // namespace

void bindInspect(py::module_& module)
{
    module.def("inspect", &inspect, py::arg("scan"), py::arg("threads"), py::arg("progress"));
}
