#pragma once

#include "relamp/delight.h"
#include "scan/rays.h"
#include "scan/texels.h"
#include "shading/thesis.h"

namespace relamp
{

/// What a Decomposition knows; the parts that write results see it too.
struct Decomposition::State
{
    explicit State(const Scan& scan) : scene(scan) {}

    RayScene scene;
    Texels texels;
    Lights lights;
    std::vector<PointLight> merged;
    ThesisShading shading;
    std::vector<uint8_t> shines; // of surfels: whether it belongs to a fixture
    DelightOptions options;
    Closure closure;
    std::vector<std::string> warnings;
};

} // namespace relamp
