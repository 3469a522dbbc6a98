#pragma once

#include "relamp/names.h"

#include <string>

#include <fmt/format.h>
#include <glm/vec3.hpp>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

/// One a public header that Python sees.
void bindScan(pybind11::module_& module);
void bindLights(pybind11::module_& module);
void bindDelight(pybind11::module_& module);
void bindRelight(pybind11::module_& module);
void bindFilm(pybind11::module_& module);
void bindInspect(pybind11::module_& module);
void bindVerify(pybind11::module_& module);

/// The value that a keyword names, or a ValueError that says which there are.
template<class Enum>
Enum namedBy(const char* keyword, const std::string& name)
{
    if (const auto value = relamp::named<Enum>(name)) return *value;
    throw pybind11::value_error(
        fmt::format("{}={:?} is none of {}", keyword, name, relamp::namesInWords<Enum>()));
}

inline pybind11::tuple tupleOf(glm::vec3 v)
{
    return pybind11::make_tuple(v.x, v.y, v.z);
}
