#ifndef RELAMP_GATHERED_LIGHT_SHARED_H
#define RELAMP_GATHERED_LIGHT_SHARED_H

#include "base/biweight.shared.h"

SHARED_BEGIN

SHARED_CONST kInterpolationReach = 1.5f; // surfel sizes
const int kMostTaps = 128;               // surfels around a texel that are looked at

// Weight of a surfel's light at a texel `way` away: near in space and facing alike.
SHARED_FN float tapWeight(vec3 way, vec3 normal, vec3 tapNormal, float perReachSquared)
{
    const float facing = max(dot(normal, tapNormal), 0.0f);
    return biweight(dot(way, way) * perReachSquared) * facing * facing * facing * facing +
           1e-9f; // some, however far
}

SHARED_END

#endif
