#ifndef RELAMP_DIRECT_GPU_H
#define RELAMP_DIRECT_GPU_H

#include "gpu/compute.h"

SHARED_BEGIN

struct DirectArguments
{
    Uvec4s site;
    Vec4s lights;      // position, then intensity, of each
    Uvec2s irradiance; // of texels, halves
    vec3 attenuation;  // k0, k1, k2
    uint lightCount;
    uint count; // of texels
};

SHARED_END

#endif
