#ifndef RELAMP_DIVIDE_SHARED_H
#define RELAMP_DIVIDE_SHARED_H

#include "base/shared.h"
#include "image/burnt_out.shared.h"

SHARED_BEGIN

SHARED_CONST kWhitestPaper = 0.9f; // albedo: no matte surface is whiter

// What a matte surface of albedo rho under shading S = E / pi shows is rho S; here S is raised to
// `darkest` before it divides, for below it noise is all there is.
SHARED_FN vec3 dividedByShading(vec3 radiance, vec3 shading, float darkest)
{
    return radiance / max(shading, vec3(darkest));
}

// What came out whiter than paper got more light than was known: how many times as much, at least.
SHARED_FN float lightThatLacks(vec3 albedo)
{
    return max(brightestChannel(albedo) / kWhitestPaper, 1.0f);
}

SHARED_END

#endif
