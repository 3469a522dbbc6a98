#include "edit.h"

relamp::DelightOptions SolverParameters::options() const
{
    relamp::DelightOptions options;
    options.solver = solver;
    options.gather = gather;
    options.pathtrace = pathtrace;
    options.thesis = thesis;
    options.albedo = albedo;
    return options;
}

void SolverParameters::forgetPlaces()
{
    gather.lights.clear();
    gather.notLights.clear();
    gather.same.clear();
    gather.white.clear();
}

bool Edit::operator==(const Edit& other) const
{
    return light == other.light && scanned == other.scanned && parameters == other.parameters &&
           view.view == other.view.view && view.exposure == other.view.exposure;
}
