#ifndef RELAMP_SKY_BINS_SHARED_H
#define RELAMP_SKY_BINS_SHARED_H

#include "base/radiometry.shared.h"

SHARED_BEGIN

// Where a picture of the sky has a unit direction, 0..1 from its left and from its top; what is
// left of 0 is that much left of 1. The middle of the picture lies towards -z, and what is right of
// it towards +x. `turn`: rad around the vertical.
SHARED_FN vec2 placeInSky(vec3 direction, float turn)
{
    return vec2((atan(direction.x, -direction.z) - turn) / (2.0f * kPi) + 0.5f,
                acos(clamp(direction.y, -1.0f, 1.0f)) / kPi);
}

SHARED_END

#endif
