#version 460
#extension GL_GOOGLE_include_directive : require

#include "scan/texels.gpu.h"
#include "thesis/lpv.gpu.h"
#include "thesis/lpv.shared.h"

ARGUMENTS(LpvReadOutArguments)

void main()
{
    const uint i = threadIndex();
    if (i >= arguments.count) return;
    const LpvCells grid = arguments.grid;
    const uvec4 site = arguments.site.at[i];
    const vec3 normal = normalOf(site);
    const vec3 at = lookUpPlace(positionOf(site), normal, grid.origin, grid.cell, grid.cells);
    const ivec3 low = ivec3(at);
    const vec3 part = at - vec3(low);
    vec4 sh[3] = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
    for (int corner = 0; corner < 8; ++corner) {
        const ivec3 step = ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
        const vec3 share = mix(1.0 - part, part, equal(step, ivec3(1)));
        const ivec3 c = low + step;
        const int cell = (c.z * grid.cells.y + c.y) * grid.cells.x + c.x;
        for (int channel = 0; channel < 3; ++channel)
            sh[channel] +=
                share.x * share.y * share.z * arguments.accumulated.at[3 * cell + channel];
    }
    const float toIrradiance = 4.0 / (grid.cell * grid.cell);
    vec3 irradiance;
    for (int channel = 0; channel < 3; ++channel)
        irradiance[channel] = irradianceFromCell(sh[channel], normal, toIrradiance);
    arguments.irradiance.at[i] = packedHalves(vec4(irradiance, 0.0));
}
