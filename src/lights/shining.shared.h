#ifndef RELAMP_SHINING_SHARED_H
#define RELAMP_SHINING_SHARED_H

#include "base/radiometry.shared.h"
#include "image/burnt_out.shared.h"

SHARED_BEGIN

// Whether a texel shines: bright as a whole, from a luminance of `threshold`, and, in a texture
// that `clips`, burnt out in a channel.
SHARED_FN bool isEmitting(vec3 radiance, bool clips, float threshold)
{
    return (!clips || isBurntOut(radiance, clips)) && luminance(radiance) >= threshold;
}

// The same of a texel of a lamp that glows `from` some luminance on, burnt out or not.
SHARED_FN bool isGlowing(vec3 radiance, float from)
{
    return luminance(radiance) >= from;
}

SHARED_END

#endif
