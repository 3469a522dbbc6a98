#pragma once

#include <memory>
#include <vector>

#include <pybind11/numpy.h>

/// A read-only array that looks at `values`, height * width of one or more channels, and keeps
/// `owner`, whose they are.
template<class Value, class Owner>
pybind11::array viewOf(const std::vector<Value>& values, const char* type, int width, int height,
                       const std::shared_ptr<Owner>& owner)
{
    namespace py = pybind11;
    const py::ssize_t pixels = static_cast<py::ssize_t>(width) * height;
    const py::ssize_t channels = pixels > 0 ? std::ssize(values) / pixels : 0;
    std::vector<py::ssize_t> shape{height, width};
    if (channels != 1) shape.push_back(channels);
    const py::capsule base(new std::shared_ptr<Owner>(owner), [](void* pointer) {
        delete static_cast<std::shared_ptr<Owner>*>(pointer);
    });
    py::array view(py::dtype(type), shape, values.data(), base);
    view.attr("flags").attr("writeable") = false;
    return view;
}
