#version 460
#extension GL_GOOGLE_include_directive : require

#include "shading/lit_sides.gpu.h"

ARGUMENTS(ExcessArguments)

void main()
{
    const uint surfel = threadIndex();
    if (surfel >= arguments.count) return;
    const vec3 excess = arguments.gathered.at[surfel].rgb - arguments.even.at[surfel].rgb;
    arguments.excess.at[surfel] = vec4(excess, 0.0);
}
