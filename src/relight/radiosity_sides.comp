#version 460
#extension GL_GOOGLE_include_directive : require

#include "relight/radiosity.gpu.h"
#include "relight/radiosity.shared.h"

ARGUMENTS(RadiositySidesArguments)

void main()
{
    const uint side = threadIndex();
    if (side >= arguments.count) return;
    vec3 irradiance = arguments.direct.at[side].rgb;
    if (arguments.ofClusters != 0)
        irradiance += arguments.irradiance.at[arguments.clusterOf.at[side]].rgb;
    else
        irradiance += arguments.irradiance.at[side].rgb + arguments.known.at[side].rgb;
    const vec3 albedo = arguments.albedo.at[arguments.surfel.at[side]].rgb;
    arguments.sent.at[side] = packedHalves(vec4(sentOn(albedo, irradiance), 0.0));
}
