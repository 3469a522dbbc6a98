#include "bind.h"

#include "relamp/error.h"
#include "relamp/version.h"

PYBIND11_MODULE(_relamp, module)
{
    module.doc() = "relamp's C++ API as Python sees it; `relamp` is what people import.";
    module.attr("__version__") = relamp::version();
    pybind11::register_exception<relamp::Error>(module, "Error", PyExc_RuntimeError);
    bindScan(module);
    bindLights(module);
    bindDelight(module);
    bindRelight(module);
    bindFilm(module);
    bindInspect(module);
    bindVerify(module);
}
