#pragma once

#include "relamp/delight.h"
#include "scan/rays.h"
#include "scan/texels.h"
#include "solve/solution.h"

namespace relamp
{

/// What a Decomposition knows; the parts that write results see it too.
struct Decomposition::State
{
    explicit State(const Scan& scan) : scene(scan) {}

    RayScene scene;
    Texels texels;
    Solution solution;
};

} // namespace relamp
