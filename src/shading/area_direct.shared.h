#ifndef RELAMP_AREA_DIRECT_SHARED_H
#define RELAMP_AREA_DIRECT_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

// By how many metres a place at `distance` from a patch lies less before it, and that before the
// place, than a scan says, where both face alike, as a ceiling and a panel in it do: these see one
// another by their tilt and by a step alone, which in a scan are errors of some degrees and of
// centimetres.
SHARED_FN float lostToTilt(vec3 normal, vec3 patchNormal, float distance)
{
    const float alike = max(dot(normal, patchNormal), 0.0f);
    const float second = alike * alike;
    const float fourth = second * second;
    const float eighth = fourth * fourth;
    return eighth * eighth * (0.04f * distance + 0.01f);
}

// Irradiance a radiance on a surface element from a patch of area 1 that faces `patchNormal`:
// cos cos' / d^2, zero where either looks away. `leastSquared` keeps a patch nearer than its own
// size from growing without end.
SHARED_FN float patchFormFactor(vec3 toPatch, vec3 normal, vec3 patchNormal, float leastSquared)
{
    const float squared = max(dot(toPatch, toPatch), 1e-12f);
    const float lost = lostToTilt(normal, patchNormal, sqrt(squared));
    const float cosines =
        max(dot(toPatch, normal) - lost, 0.0f) * max(-dot(toPatch, patchNormal) - lost, 0.0f);
    return cosines / (squared * max(squared, leastSquared));
}

SHARED_END

#endif
