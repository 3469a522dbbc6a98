#ifndef RELAMP_RAMP_SHARED_H
#define RELAMP_RAMP_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

// 0 at `from` and beyond it, 1 at `to` and beyond that, even between; `from` may be the larger.
SHARED_FN float ramp(float from, float to, float value)
{
    return clamp((value - from) / (to - from), 0.0f, 1.0f);
}

SHARED_END

#endif
