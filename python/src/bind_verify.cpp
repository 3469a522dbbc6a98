#include "bind.h"
#include "watched.h"

#include "relamp/verify.h"

namespace
{

namespace py = pybind11;
using namespace py::literals;

py::list binsOf(const relamp::Verification& found)
{
    py::list bins;
    for (const relamp::VerifiedBin& bin : found.bins)
        bins.append(py::dict("shading"_a = bin.shading, "ratio"_a = bin.ratio,
                             "rms_error"_a = bin.rmsError));
    return bins;
}

/// What relamp/verification.py makes a Verification of: its arguments by name.
py::dict verify(const std::filesystem::path& folder, int samples, int places, uint32_t seed,
                const std::filesystem::path& scan, bool allowOutside, int threads,
                const py::object& progress)
{
    const relamp::VerifyOptions options{.samples = samples,
                                        .places = places,
                                        .seed = seed,
                                        .scan = scan,
                                        .allowOutside = allowOutside};
    const relamp::Verification found = watched(progress, threads, [&](relamp::Progress& watch) {
        return relamp::verify(folder, options, watch);
    });
    return py::dict(
        "scan"_a = found.scanFile, "fixtures"_a = found.fixtures, "places"_a = found.places,
        "rms_error"_a = found.rmsError, "standard_error"_a = found.standardError,
        "rms_of_scan"_a = found.rmsOfScan, "as_white_as_paper"_a = found.asWhiteAsPaper,
        "rms_error_elsewhere"_a = found.rmsErrorElsewhere, "psnr"_a = found.psnr,
        "ratio"_a = tupleOf(found.ratio), "bins"_a = binsOf(found), "warnings"_a = found.warnings);
}

} // namespace

void bindVerify(py::module_& module)
{
    module.def("verify", &verify, py::arg("folder"), py::arg("samples"), py::arg("places"),
               py::arg("seed"), py::arg("scan"), py::arg("allow_outside"), py::arg("threads"),
               py::arg("progress"));
}
