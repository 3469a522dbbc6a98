#ifndef RELAMP_BURNT_OUT_SHARED_H
#define RELAMP_BURNT_OUT_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

// Where a channel of a texture counts as at the top of its range: JPEG rings around a burnt-out
// spot by a few of its 255 steps.
SHARED_CONST kBurntOut = 0.97f;

// What is darker was seen as it is: photos are blended to a texture, and some of them may be burnt
// out where others are not.
SHARED_CONST kSafelyBelow = 0.9f;

SHARED_FN float brightestChannel(vec3 rgb)
{
    return max(rgb.x, max(rgb.y, rgb.z));
}

// Whether a texel may have been brighter than it says. `clips`: Image::clipsAtWhite.
SHARED_FN bool isBurntOut(vec3 rgb, bool clips)
{
    return clips && brightestChannel(rgb) >= kBurntOut;
}

SHARED_END

#endif
