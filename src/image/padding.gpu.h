#ifndef RELAMP_PADDING_GPU_H
#define RELAMP_PADDING_GPU_H

#include "gpu/compute.h"

SHARED_BEGIN

// One level of push and pull: a thread a pixel of the level that is written. Pixels are halves; the
// last is 1 where the picture counts.
struct PaddingArguments
{
    Uvec2s fine;
    Uvec2s coarse;
    uint fineWidth;
    uint fineHeight;
    uint coarseWidth;
    uint count;
};

SHARED_END

#endif
