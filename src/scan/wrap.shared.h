#ifndef RELAMP_WRAP_SHARED_H
#define RELAMP_WRAP_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

// The pixel of a row or column of `size` that stands for whole number `pixel`, which may lie
// beyond.
SHARED_FN float wrappedPixel(float pixel, float size, bool repeats)
{
    if (pixel >= 0.0f && pixel <= size - 1.0f) return pixel; // nearly always
    const float inside = repeats ? pixel - size * floor(pixel / size) : pixel;
    return clamp(inside, 0.0f, size - 1.0f);
}

SHARED_END

#endif
