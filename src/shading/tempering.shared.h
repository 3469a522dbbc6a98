#ifndef RELAMP_TEMPERING_SHARED_H
#define RELAMP_TEMPERING_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

SHARED_CONST kLeastTempered = 1e-5f; // shading; in halves less is black

// What a shading is to be multiplied by to become factor shading^power: light that is believed to a
// part only, and scaled.
SHARED_FN vec3 temperedBy(vec3 shading, vec3 factor, float power)
{
    if (power == 1.0f) return factor;
    return factor * pow(max(shading, vec3(kLeastTempered)), vec3(power - 1.0f));
}

SHARED_END

#endif
