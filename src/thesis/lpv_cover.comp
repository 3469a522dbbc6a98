#version 460
#extension GL_GOOGLE_include_directive : require

#include "thesis/lpv.gpu.h"
#include "thesis/lpv.shared.h"

ARGUMENTS(LpvCoverArguments)

vec4 corner(uint i)
{
    return vec4(arguments.corners.at[4 * i], arguments.corners.at[4 * i + 1],
                arguments.corners.at[4 * i + 2], arguments.corners.at[4 * i + 3]) /
           kCoverageUnits;
}

void main()
{
    const uint i = threadIndex();
    if (i >= arguments.count) return;
    const uvec3 next =
        uvec3(1, arguments.cells.x, arguments.cells.x * arguments.cells.y); // along x, y, z
    for (int axis = 0; axis < 3; ++axis) {
        const uint a = next[(axis + 1) % 3];
        const uint b = next[(axis + 2) % 3];
        // A face lies between four corners.
        arguments.coverage.at[3 * i + axis] =
            i < a + b ? vec4(0.0)
                      : 0.25 * (corner(i) + corner(i - a) + corner(i - b) + corner(i - a - b));
    }
}
