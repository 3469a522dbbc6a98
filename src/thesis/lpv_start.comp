#version 460
#extension GL_GOOGLE_include_directive : require

#include "thesis/lpv.gpu.h"

ARGUMENTS(LpvStartArguments)

void main()
{
    const uint i = threadIndex();
    if (i >= arguments.count) return;
    vec4 sh;
    for (int k = 0; k < 4; ++k)
        sh[k] = arguments.fluxPerUnit * float(arguments.injected.at[4 * i + k]);
    arguments.travelling.at[i] = sh;
    arguments.accumulated.at[i] = sh;
}
