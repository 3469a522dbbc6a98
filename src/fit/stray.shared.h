#ifndef RELAMP_STRAY_SHARED_H
#define RELAMP_STRAY_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

const int kStrayKnots = 8;            // octaves of shading
SHARED_CONST kFirstStrayKnot = -5.0f; // log2 of shading

// Where a shading lies among the knots: 0 .. kStrayKnots - 1.
SHARED_FN float amongStrayKnots(float shading)
{
    return clamp(log2(max(shading, 1e-4f)) - kFirstStrayKnot, 0.0f, float(kStrayKnots - 1));
}

// What is left of a shading `share` of the way between two knots at which it is that many octaves
// too high.
SHARED_FN float keptOfStray(float lower, float higher, float share)
{
    return exp2(-(lower + share * (higher - lower)));
}

SHARED_END

#endif
