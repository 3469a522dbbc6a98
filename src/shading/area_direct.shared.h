#ifndef RELAMP_AREA_DIRECT_SHARED_H
#define RELAMP_AREA_DIRECT_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

// Irradiance a radiance on a surface element from a patch of area 1 that faces `patchNormal`:
// cos cos' / d^2, zero where either looks away. `leastSquared` keeps a patch nearer than its own
// size from growing without end.
SHARED_FN float patchFormFactor(vec3 toPatch, vec3 normal, vec3 patchNormal, float leastSquared)
{
    const float squared = max(dot(toPatch, toPatch), 1e-12f);
    const float cosines = max(dot(toPatch, normal), 0.0f) * max(-dot(toPatch, patchNormal), 0.0f);
    return cosines / (squared * max(squared, leastSquared));
}

SHARED_END

#endif
