#ifndef RELAMP_RADIOSITY_SHARED_H
#define RELAMP_RADIOSITY_SHARED_H

#include "base/radiometry.shared.h"

SHARED_BEGIN

const int kStepOfSides = 4; // of their rays, one that is asked what a side sends on

// Radiance that a matte surface sends on of what it receives.
SHARED_FN vec3 sentOn(vec3 albedo, vec3 irradiance)
{
    return albedo * irradiance / kPi;
}

SHARED_END

#endif
