#pragma once

#include "relamp/delight.h"
#include "scan/rays.h"
#include "scan/texels.h"
#include "solve/solution.h"

#include <memory>

namespace relamp
{

/// What a Decomposition knows; the parts that write results see it too.
struct Decomposition::State
{
    std::shared_ptr<const Scan> scan;
    std::shared_ptr<const RayScene> scene; // of it, as the next
    std::shared_ptr<const Texels> texels;
    Solution solution; // refers to all of them
};

} // namespace relamp
