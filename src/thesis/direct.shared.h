#ifndef RELAMP_DIRECT_SHARED_H
#define RELAMP_DIRECT_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

// Choi 2018: direct light of an isotropic source of intensity 1, without visibility:
// cos / (k0 + k1 d + k2 d^2), zero behind. k = (0, 0, 1) is the inverse-square law.
SHARED_FN float receivedFrom(vec3 toLight, vec3 normal, vec3 k)
{
    const float distanceSquared = max(dot(toLight, toLight), 1e-8f);
    const float distance = sqrt(distanceSquared);
    const float fallOff = k.x + k.y * distance + k.z * distanceSquared;
    return max(dot(normal, toLight), 0.0f) / (distance * fallOff);
}

SHARED_END

#endif
