#version 460
#extension GL_GOOGLE_include_directive : require

#include "shading/lit_sides.gpu.h"

ARGUMENTS(LitSidesMeanArguments)

void main()
{
    const uint surfel = threadIndex();
    if (surfel >= arguments.count) return;
    const uint begin = arguments.firstNeighbor.at[surfel];
    const uint end = arguments.firstNeighbor.at[surfel + 1];
    vec4 sum = vec4(0.0);
    for (uint i = begin; i < end; ++i) sum += arguments.values.at[arguments.neighbor.at[i]];
    arguments.means.at[surfel] = sum / float(end - begin);
}
