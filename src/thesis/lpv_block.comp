#version 460
#extension GL_GOOGLE_include_directive : require

#include "thesis/lpv.gpu.h"
#include "thesis/lpv.shared.h"

ARGUMENTS(LpvBlockArguments)

void main()
{
    const uint i = threadIndex();
    if (i >= arguments.count) return;
    const LpvCells grid = arguments.grid;
    const vec4 place = arguments.position.at[i];
    const ivec3 at = cellHolding(place.xyz - 0.5 * grid.cell, grid.origin, grid.cell, grid.cells);
    const int cell = (at.z * grid.cells.y + at.y) * grid.cells.x + at.x;
    const vec4 lobe = place.w / (grid.cell * grid.cell) * shLobe(arguments.normal.at[i].xyz);
    for (int k = 0; k < 4; ++k)
        atomicAdd(arguments.corners.at[4 * cell + k], int(round(kCoverageUnits * lobe[k])));
}
