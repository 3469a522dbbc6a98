#ifndef RELAMP_EXPAND_SHARED_H
#define RELAMP_EXPAND_SHARED_H

#include "base/radiometry.shared.h"

SHARED_BEGIN

// Inverse of Reinhard's tone curve L / (1 + k L), k = 1 - 1 / peak (Reinhard et al. 2002, without
// the burn-out term): leaves the dark as it is and takes white to `peak`. Keeps the hue.
SHARED_FN vec3 expanded(vec3 radiance, float peak)
{
    const float l = min(luminance(radiance), 1.0f);
    return radiance / (1.0f - l * (1.0f - 1.0f / peak));
}

SHARED_END

#endif
