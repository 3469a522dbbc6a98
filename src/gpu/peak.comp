#version 460
#extension GL_GOOGLE_include_directive : require

#include "gpu/peak.gpu.h"

ARGUMENTS(PeakArguments)

void main()
{
    const uint i = threadIndex();
    vec4 chains[kPeakChains];
    for (uint c = 0; c < kPeakChains; ++c) chains[c] = vec4(i + c);
    for (uint loop = 0; loop < arguments.loops; ++loop)
        for (uint c = 0; c < kPeakChains; ++c) chains[c] = 0.999 * chains[c] + 0.001;
    vec4 sum = vec4(0.0);
    for (uint c = 0; c < kPeakChains; ++c) sum += chains[c];
    arguments.sums.at[i] = sum;
}
