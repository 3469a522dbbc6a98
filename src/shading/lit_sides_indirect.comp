#version 460
#extension GL_GOOGLE_include_directive : require

#include "base/radiometry.shared.h"
#include "shading/lit_sides.gpu.h"
#include "shading/lit_sides.shared.h"

ARGUMENTS(IndirectArguments)

void main()
{
    const uint surfel = threadIndex();
    if (surfel >= arguments.count) return;
    const uint begin = arguments.firstNeighbor.at[surfel];
    const uint end = arguments.firstNeighbor.at[surfel + 1];
    vec3 sum = vec3(0.0);
    float squaredNoise = 0.0;
    for (uint i = begin; i < end; ++i) {
        const vec4 even = arguments.even.at[arguments.neighbor.at[i]]; // whole: see docs/dev/gpu.md
        sum += even.rgb;
        squaredNoise += even.w * even.w;
    }
    const float around = float(end - begin);
    const vec3 own = arguments.even.at[surfel].rgb;
    const vec3 way = sum / around - own;
    const float share = shareOfNoise(luminance(abs(way)), squaredNoise / around);
    arguments.irradiance.at[surfel] =
        vec4(own + share * way + arguments.excess.at[surfel].rgb, arguments.lit.at[surfel]);
}
