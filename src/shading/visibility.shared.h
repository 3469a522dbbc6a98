#ifndef RELAMP_VISIBILITY_SHARED_H
#define RELAMP_VISIBILITY_SHARED_H

#include "base/biweight.shared.h"

SHARED_BEGIN

// Seen, as numbers.
const int kSeesNothing = 0;
const int kSeesAll = 1;
const int kSeesSome = 2;

// The share that a probe sees, in a byte.
const int kShareOfAll = 250;
const int kShareUnknown = 255; // it faces away

const int kMostProbes = 256; // around a surfel that are looked at

// Weight of a probe's word at a place `way` away.
SHARED_FN float probeWeight(vec3 way, float perReachSquared)
{
    return biweight(dot(way, way) * perReachSquared) + 1e-6f; // some, however far
}

SHARED_END

#endif
