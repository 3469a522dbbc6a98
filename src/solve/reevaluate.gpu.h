#ifndef RELAMP_REEVALUATE_GPU_H
#define RELAMP_REEVALUATE_GPU_H

#include "gpu/compute.h"
#include "shading/lamp_terms.gpu.h"

SHARED_BEGIN

struct ReevaluateArguments
{
    Uvec4s site; // of texels
    Uints surfel;
    Vec4s position; // of surfels
    Vec4s normal;
    Uints firstNeighbor;
    Uints neighbor;
    Vec4s indirect;   // of surfels; w: share of the light that is there
    LampTerms lamps;  // on texels
    Uvec2s directOut; // of texels: irradiance, halves
    Uvec2s indirectOut;
    float perReachSquared;
};

SHARED_END

#endif
