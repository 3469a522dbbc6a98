#version 460
#extension GL_GOOGLE_include_directive : require

#include "shading/lamp_terms.gpu.h"

ARGUMENTS(LampTermsSumArguments)

void main()
{
    const uint place = threadIndex();
    if (place >= arguments.lamps.count) return;
    arguments.irradiance.at[place] =
        packedHalves(vec4(irradianceOfLamps(arguments.lamps, place), 0.0));
}
