#ifndef RELAMP_ENCLOSED_TEXELS_SHARED_H
#define RELAMP_ENCLOSED_TEXELS_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

// As much of the light around an enclosed texel as gives it the albedo around: from none to all of
// it. Luminances: `seen` of the texel and `under` of its shading, `around` and `albedo` of what is
// around.
SHARED_FN float shareOfRim(float seen, float under, float around, float albedo)
{
    if (around <= under) return 0.0f;
    return clamp((seen / albedo - under) / (around - under), 0.0f, 1.0f);
}

SHARED_END

#endif
