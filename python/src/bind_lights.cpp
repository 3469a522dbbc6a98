#include "bind.h"

#include "relamp/lights.h"

namespace
{

namespace py = pybind11;

/// What relamp/lights.py makes a Fixture of: its arguments by name.
py::dict fixtureOf(const relamp::Lights& lights, size_t place)
{
    using namespace py::literals;
    const relamp::Fixture& fixture = lights.fixtures[place];
    return py::dict("id"_a = lights.idOf(place), "name"_a = lights.nameOf(place),
                    "centre"_a = tupleOf(fixture.centre), "normal"_a = tupleOf(fixture.normal),
                    "area"_a = fixture.area, "radiance"_a = tupleOf(fixture.radiance),
                    "power"_a = tupleOf(fixture.power()), "error"_a = tupleOf(fixture.error),
                    "determined"_a = fixture.determined);
}

py::list fixturesOf(const relamp::Lights& lights)
{
    py::list fixtures;
    for (size_t place = 0; place < lights.fixtures.size(); ++place)
        fixtures.append(fixtureOf(lights, place));
    return fixtures;
}

py::object sunOf(const relamp::Lights& lights)
{
    using namespace py::literals;
    if (!lights.sun) return py::none();
    return py::dict("direction"_a = tupleOf(lights.sun->direction),
                    "irradiance"_a = tupleOf(lights.sun->irradiance),
                    "determined"_a = lights.sun->determined);
}

} // namespace

void bindLights(py::module_& module)
{
    py::class_<relamp::Lights>(module, "Lights", "All light of a room, as delight found it.")
        .def_property_readonly("fixtures", &fixturesOf, "A dict a lamp or window.")
        .def_property_readonly("sun", &sunOf, "A dict, or None.")
        .def_property_readonly(
            "ambient", [](const relamp::Lights& lights) { return tupleOf(lights.ambient); },
            "RGB radiance of what lies outside, seen through the scan's holes.")
        .def("to_json", &relamp::lightsAsJson, "The text of lights.json.");
}
