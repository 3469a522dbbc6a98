#ifndef RELAMP_PEAK_GPU_H
#define RELAMP_PEAK_GPU_H

#include "gpu/compute.h"

SHARED_BEGIN

const uint kPeakChains = 4u; // of four lanes each, so that one does not wait for another

struct PeakArguments
{
    Vec4s sums; // of threads
    uint loops;
};

SHARED_END

#endif
