#version 460
#extension GL_GOOGLE_include_directive : require

#include "thesis/lpv.gpu.h"
#include "thesis/lpv.shared.h"

ARGUMENTS(LpvArguments)

// Light that comes from one neighbour, through its five faces.
vec4 arrivingFrom(int source, int cell, int channel, ivec3 next)
{
    const vec3 travel = travelFrom(source);
    const int axis = source / 2;
    const int from = cell - int(travel[axis]) * next[axis];
    // Coverage is stored at the lower of the two cells that a face parts.
    const int wall = travel[axis] > 0.0 ? from : cell;
    const vec4 sh = arguments.travelling.at[3 * from + channel];
    const vec4 coverage =
        arguments.blocking != 0 ? arguments.coverage.at[3 * wall + axis] : vec4(0.0);
    vec4 sum = vec4(0.0);
    for (int face = 0; face < 5; ++face) {
        const vec3 direction = faceDirection(source, face);
        sum += sentTowards(sh, direction) * (1.0f - blocked(coverage, direction)) *
               (faceSolidAngle(face) / kPi) * shLobe(faceNormal(source, face));
    }
    return sum;
}

void main()
{
    const uint i = threadIndex();
    if (i >= arguments.count) return;
    const int cell = int(i) / 3;
    const ivec3 cells = arguments.cells;
    const ivec3 at = ivec3(cell % cells.x, cell / cells.x % cells.y, cell / (cells.x * cells.y));
    if (any(equal(at, ivec3(0))) || any(equal(at, cells - 1))) return; // the border stays empty
    vec4 sum = vec4(0.0);
    for (int source = 0; source < 6; ++source)
        sum += arrivingFrom(source, cell, int(i) % 3, ivec3(1, cells.x, cells.x * cells.y));
    arguments.arriving.at[i] = sum;
    arguments.accumulated.at[i] += sum;
}
