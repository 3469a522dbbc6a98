#version 460
#extension GL_GOOGLE_include_directive : require

#include "lights/expand.shared.h"
#include "shading/lit_sides.gpu.h"
#include "shading/lit_sides.shared.h"

ARGUMENTS(IndirectArguments)

vec3 evenAt(uint surfel)
{
    return arguments.even.at[surfel].rgb + arguments.ambient * arguments.missed.at[surfel];
}

void main()
{
    const uint surfel = threadIndex();
    if (surfel >= arguments.count) return;
    const uint begin = arguments.firstNeighbor.at[surfel];
    const uint end = arguments.firstNeighbor.at[surfel + 1];
    vec3 sum = vec3(0.0);
    for (uint i = begin; i < end; ++i) sum += evenAt(arguments.neighbor.at[i]);
    const vec3 own = evenAt(surfel);
    const vec3 way = sum / float(end - begin) - own;
    const vec4 gathered = arguments.even.at[surfel]; // whole: see docs/dev/gpu.md
    const float share = shareOfNoise(luminance(abs(way)), gathered.w);
    arguments.irradiance.at[surfel] =
        vec4(own + share * way + arguments.excess.at[surfel].rgb, arguments.lit.at[surfel]);
}
