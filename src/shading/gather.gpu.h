#ifndef RELAMP_GATHER_GPU_H
#define RELAMP_GATHER_GPU_H

#include "gpu/compute.h"

SHARED_BEGIN

struct GatherArguments
{
    Uints first;      // of lists, and one more: where their targets begin
    Uints target;     // what rays met, as indices of radiances
    Uvec2s radiance;  // halves
    Vec4s irradiance; // of lists; w: standard error of its luminance
    Floats missed;    // of directions that met nothing, at radiance 1
    uint outside;     // the targets from here on are outside
    uint step;        // of rays, one that counts
    uint count;       // of lists
};

struct SettlingArguments
{
    Uints first;      // of lists, as above
    Vec4s plain;      // irradiance of lists by what does not change
    Uints firstOther; // of lists, and one more: where those of their targets begin that do
    Uints other;
    Uvec2s radiance; // halves
    Vec4s irradiance;
    uint count; // of lists
};

SHARED_END

#endif
