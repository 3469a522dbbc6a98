#version 460
#extension GL_GOOGLE_include_directive : require

#include "scan/texels.gpu.h"
#include "thesis/direct.gpu.h"
#include "thesis/direct.shared.h"

ARGUMENTS(DirectArguments)

void main()
{
    const uint i = threadIndex();
    if (i >= arguments.count) return;
    const uvec4 site = arguments.site.at[i];
    const vec3 position = positionOf(site);
    const vec3 normal = normalOf(site);
    vec3 irradiance = vec3(0.0);
    for (uint light = 0; light < arguments.lightCount; ++light) {
        const vec3 toLight = arguments.lights.at[2 * light].xyz - position;
        irradiance += receivedFrom(toLight, normal, arguments.attenuation) *
                      arguments.lights.at[2 * light + 1].rgb;
    }
    arguments.irradiance.at[i] = packedHalves(vec4(irradiance, 0.0));
}
