#ifndef RELAMP_BURNT_OUT_SHARED_H
#define RELAMP_BURNT_OUT_SHARED_H

#include "base/ramp.shared.h"
#include "base/shared.h"

SHARED_BEGIN

// Where a channel of a texture counts as at the top of its range: JPEG rings around a burnt-out
// spot by a few of its 255 steps.
SHARED_CONST kBurntOut = 0.97f;

// The most that anything else may be made of: half floats tell it from kBurntOut.
SHARED_CONST kBrightestPlain = 0.999f * kBurntOut;

// What is darker was seen as it is: photos are blended to a texture, and some of them may be burnt
// out where others are not.
SHARED_CONST kSafelyBelow = 0.9f;

SHARED_FN float brightestChannel(vec3 rgb)
{
    return max(rgb.x, max(rgb.y, rgb.z));
}

// The following go by what a texture shows, 1 = white, before any gain is taken out of it. `clips`:
// Image::clipsAtWhite.

// Whether a texel may have been brighter than it says.
SHARED_FN bool isBurntOut(vec3 rgb, bool clips)
{
    return clips && brightestChannel(rgb) >= kBurntOut;
}

// How likely each channel is burnt out, 0..1.
SHARED_FN vec3 burntOutShares(vec3 rgb, bool clips)
{
    if (!clips) return vec3(0.0f);
    return vec3(ramp(kSafelyBelow, kBurntOut, rgb.x), ramp(kSafelyBelow, kBurntOut, rgb.y),
                ramp(kSafelyBelow, kBurntOut, rgb.z));
}

SHARED_END

#endif
