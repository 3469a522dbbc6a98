#version 460
#extension GL_GOOGLE_include_directive : require

#include "shading/gather.gpu.h"
#include "shading/gather.shared.h"

ARGUMENTS(SettlingArguments)

void main()
{
    const uint list = threadIndex();
    if (list >= arguments.count) return;
    const uint rays = arguments.first.at[list + 1] - arguments.first.at[list];
    const uint end = arguments.firstOther.at[list + 1];
    vec3 sum = vec3(0.0);
    for (uint i = arguments.firstOther.at[list]; i < end; ++i)
        sum += halves(arguments.radiance.at[arguments.other.at[i]]).rgb;
    const vec3 plain = arguments.plain.at[list].rgb;
    arguments.irradiance.at[list] = vec4(plain + irradiancePerRay(float(rays)) * sum, 0.0);
}
