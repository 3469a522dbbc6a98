#ifndef RELAMP_DIVIDE_SHARED_H
#define RELAMP_DIVIDE_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

// What a matte surface of albedo rho under shading S = E / pi shows is rho S; here S is raised to
// `darkest` before it divides, for below it noise is all there is.
SHARED_FN vec3 dividedByShading(vec3 radiance, vec3 shading, float darkest)
{
    return radiance / max(shading, vec3(darkest));
}

SHARED_END

#endif
