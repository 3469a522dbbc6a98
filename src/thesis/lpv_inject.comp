#version 460
#extension GL_GOOGLE_include_directive : require

#include "thesis/lpv.gpu.h"
#include "thesis/lpv.shared.h"

ARGUMENTS(LpvInjectArguments)

void main()
{
    const uint i = threadIndex();
    if (i >= arguments.count || arguments.pixels.at[i].page == ~0u) return;
    const LpvCells grid = arguments.grid;
    const vec3 normal = arguments.pixels.at[i].normal;
    const vec3 place = arguments.pixels.at[i].position + 0.5 * grid.cell * normal;
    const ivec3 at = cellHolding(place, grid.origin, grid.cell, grid.cells);
    const int cell = (at.z * grid.cells.y + at.y) * grid.cells.x + at.x;
    const vec3 flux = arguments.leaving.at[i].rgb;
    for (int channel = 0; channel < 3; ++channel) {
        const vec4 sh = arguments.unitsPerFlux * flux[channel] / kPi * shLobe(normal);
        for (int k = 0; k < 4; ++k)
            atomicAdd(arguments.injected.at[12 * cell + 4 * channel + k], int(round(sh[k])));
    }
}
