#ifndef RELAMP_TEMPERING_SHARED_H
#define RELAMP_TEMPERING_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

SHARED_CONST kLeastTempered = 1e-5f; // of what is kept; in halves less is black

// What a shading is to be multiplied by to become kept (shading / kept)^power: light that is
// believed to a part only, and the albedo as it was where shading is `kept`. Of a power of 1 it is
// 1.
SHARED_FN vec3 temperedBy(vec3 shading, vec3 kept, float power)
{
    if (power == 1.0f) return vec3(1.0f);
    return pow(max(shading / kept, vec3(kLeastTempered)), vec3(power - 1.0f));
}

SHARED_END

#endif
