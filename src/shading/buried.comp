#version 460
#extension GL_GOOGLE_include_directive : require

#include "shading/buried.gpu.h"

ARGUMENTS(BuriedArguments)

vec3 openIrradiance(uint surfel)
{
    const vec3 own = arguments.irradiance.at[surfel].rgb;
    if (arguments.isBuried.at[surfel] == 0) return own;
    vec3 sum = vec3(0.0);
    float count = 0.0;
    const uint end = arguments.firstNeighbor.at[surfel + 1];
    for (uint i = arguments.firstNeighbor.at[surfel]; i < end; ++i) {
        const uint other = arguments.neighbor.at[i];
        if (arguments.isBuried.at[other] != 0) continue;
        sum += arguments.irradiance.at[other].rgb;
        count += 1.0;
    }
    return count > 0.0 ? sum / count : own;
}

void main()
{
    const uint surfel = threadIndex();
    if (surfel >= arguments.count) return;
    arguments.open.at[surfel] = vec4(openIrradiance(surfel), arguments.fourth.at[surfel]);
}
