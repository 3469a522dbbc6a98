#ifndef RELAMP_BURIED_GPU_H
#define RELAMP_BURIED_GPU_H

#include "gpu/compute.h"

SHARED_BEGIN

struct BuriedArguments
{
    Vec4s irradiance; // of surfels
    Uints isBuried;   // of surfels
    Uints firstNeighbor;
    Uints neighbor;
    Floats fourth; // of surfels: w of what is written
    Vec4s open;    // irradiance without what is buried
    uint count;
};

SHARED_END

#endif
