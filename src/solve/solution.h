#pragma once

#include "albedo/doubts.h"
#include "lights/shining.h"
#include "relamp/delight.h"
#include "shading/texel_shading.h"

#include <string>
#include <vector>

namespace relamp
{

/// What a solver makes of a scan: its lights, and the shading that they give any texel.
struct Solution
{
    Lights lights;
    std::vector<PointLight> merged; // the same light, for formats that know points alone
    TexelShading shade;             // refers to the texels and the scene that were solved
    Shining shining;
    std::vector<SurfelTrust> trust; // in the shading of surfels; empty: full
    std::vector<glm::vec3> fill;    // albedo of surfels, for texels that cannot be trusted; or none
    DelightOptions options;         // as given, and all that was derived
    Closure closure;
    std::vector<std::string> warnings;
};

} // namespace relamp
