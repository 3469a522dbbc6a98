#version 460
#extension GL_GOOGLE_include_directive : require

#include "albedo/divide.shared.h"
#include "thesis/divide.gpu.h"
#include "thesis/thesis_shading.shared.h"

ARGUMENTS(DivideArguments)

void main()
{
    const uint i = threadIndex();
    if (i >= arguments.count) return;
    const vec3 shading =
        shadingFrom(halves(arguments.direct.at[i]).rgb, arguments.power, vec3(0.0)) +
        shadingFrom(halves(arguments.indirect.at[i]).rgb, arguments.power, arguments.ambient);
    const vec3 albedo =
        dividedByShading(halves(arguments.radiance.at[i]).rgb, shading, arguments.darkest);
    arguments.albedo.at[arguments.pixel.at[i]] =
        packedHalves(vec4(albedo / lightThatLacks(albedo), 1.0));
}
