#ifndef RELAMP_DIVIDE_GPU_H
#define RELAMP_DIVIDE_GPU_H

#include "gpu/compute.h"

SHARED_BEGIN

struct DivideArguments
{
    Uvec2s radiance; // of texels, halves
    Uvec2s direct;   // irradiance before `power`, halves
    Uvec2s indirect;
    Uints pixel;
    Uvec2s albedo; // of pixels, halves; the last is 1 where a texel is
    vec3 ambient;
    float power;
    float darkest;
    uint count; // of texels
};

SHARED_END

#endif
