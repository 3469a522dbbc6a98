#pragma once

#include "albedo/page_layers.h"
#include "gpu/in_force.h"
#include "lights/glow_marks.h"
#include "relamp/delight.h"

#include <functional>
#include <string>
#include <vector>

namespace relamp
{

/// What a solver makes of a scan: its lights, and the shading that they give any texel.
struct Solution
{
    Lights lights;
    std::vector<Opening> openings;
    std::vector<PointLight> merged; // the same light, for formats that know points alone
    SolvedTexels texels;
    std::vector<float> lit;               // of surfels, correctionOf() them; empty: none was made
    std::vector<int32_t> fixtureOf;       // of surfels, as fixtureMapOf() takes it
    GlowMarks glowing;                    // what counts as burnt out besides
    DeviceLayers onDevice;                // makes the layers of `texels`; null: the CPU does
    DelightOptions options;               // as given, and all that was derived but the engine
    std::function<gpu::InForce()> engine; // what makes layers, which may change meanwhile; null: no
                                          // GPU can
    Closure closure;
    CrossValidation crossValidation;
    std::vector<std::string> warnings;
};

} // namespace relamp
