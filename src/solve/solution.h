#pragma once

#include "albedo/page_layers.h"
#include "relamp/delight.h"

#include <string>
#include <vector>

namespace relamp
{

/// What a solver makes of a scan: its lights, and the shading that they give any texel.
struct Solution
{
    Lights lights;
    std::vector<PointLight> merged; // the same light, for formats that know points alone
    SolvedTexels texels;
    DeviceLayers onDevice;  // makes the layers of `texels`; null: the CPU does
    DelightOptions options; // as given, and all that was derived
    Closure closure;
    std::vector<std::string> warnings;
};

} // namespace relamp
