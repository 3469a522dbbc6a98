#ifndef RELAMP_LPV_GPU_H
#define RELAMP_LPV_GPU_H

#include "gpu/compute.h"
#include "thesis/rsm.gpu.h"

SHARED_BEGIN

// The grid, as LpvGrid.
struct LpvCells
{
    ivec3 cells;
    vec3 origin;
    float cell; // m
};

// Sums that many threads add to are kept in whole numbers, so that their order does not matter:
// coverage in this many units of a cell's face, light in units that the caller says.
SHARED_CONST kCoverageUnits = 262144.0f;

// Adds surfels to the corners between cells: a thread a surfel.
struct LpvBlockArguments
{
    Vec4s position; // of surfels; w: area
    Vec4s normal;
    Ints corners; // four a cell, in units
    LpvCells grid;
    uint count;
};

// From corners to faces: a thread a cell.
struct LpvCoverArguments
{
    Ints corners;
    Vec4s coverage; // three a cell: of the faces towards the next along x, y, z
    ivec3 cells;
    uint count;
};

// Adds bounce light, each half a cell in front of its surface: a thread a pixel.
struct LpvInjectArguments
{
    RsmPixels pixels;
    Vec4s leaving;
    Ints injected; // twelve a cell: channel after channel
    LpvCells grid;
    float unitsPerFlux;
    uint count;
};

// The light that propagation begins with: a thread a channel of a cell.
struct LpvStartArguments
{
    Ints injected;
    Vec4s travelling; // three a cell: coefficients of a channel
    Vec4s accumulated;
    float fluxPerUnit;
    uint count;
};

// One step of all light to the next cells: a thread a channel of a cell.
struct LpvArguments
{
    Vec4s travelling;
    Vec4s arriving;
    Vec4s accumulated;
    Vec4s coverage;
    ivec3 cells;
    uint blocking; // 0 in the first step: surfaces do not hold up what they sent
    uint count;
};

// Irradiance on texels.
struct LpvReadOutArguments
{
    Uvec4s site;
    Vec4s accumulated;
    Uvec2s irradiance; // halves
    LpvCells grid;
    uint count;
};

SHARED_END

#endif
