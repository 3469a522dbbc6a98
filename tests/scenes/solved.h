#pragma once

#include "scan/rays.h"
#include "solve/reevaluate.h"

namespace relamp::scenes
{

/// A scan that the gather solver has solved as far as its light goes.
struct Solved
{
    explicit Solved(Scan theScan);
    Solved(const Solved&) = delete;
    Solved& operator=(const Solved&) = delete;

    Scan scan;
    RayScene scene; // of `scan`, as are the texels
    Texels texels;
    SolvedRoom solved;
};

} // namespace relamp::scenes
