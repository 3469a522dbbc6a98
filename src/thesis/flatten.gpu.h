#ifndef RELAMP_FLATTEN_GPU_H
#define RELAMP_FLATTEN_GPU_H

#include "gpu/compute.h"

SHARED_BEGIN

// Adds the texels of one page to the cells of their surfels, kFlattenBins each: a thread a run.
struct FlattenGatherArguments
{
    Uvec2s radiance; // of texels: halves, the last is the texel's width in mm
    Uvec2s runs;     // surfel, first texel
    Vec4s cells;     // sums of square roots times area, and of area, m^2
    uint count;      // of runs
};

// Sums become means, and those of a surfel that hold anything come first: a thread a surfel.
struct FlattenFinishArguments
{
    Vec4s cells;
    uint count; // of surfels
};

// Filters the texels of one page.
struct FlattenArguments
{
    Uvec4s site;
    Uvec2s radiance;
    Uints surfel;
    Uints pixel;
    Vec4s cells;
    Vec4s position; // of surfels
    Vec4s normal;
    Uints firstNeighbor;
    Uints neighbor;
    Uints flattened; // of pixels: bytes of square roots
    float perReachSquared;
    float perRangeSquared;
    uint count; // of texels
};

SHARED_END

#endif
