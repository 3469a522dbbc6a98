#ifndef RELAMP_RELIABILITY_SHARED_H
#define RELAMP_RELIABILITY_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

SHARED_CONST kRight = 0.15f; // of log light: an error that people hardly see

// That an error of this variance is within kRight, by Student's distribution of two degrees of
// freedom: its tails are as long as those of the errors of light.
SHARED_FN float probabilityRight(float variance)
{
    const float t = kRight / sqrt(variance);
    return t / sqrt(2.0f + t * t);
}

// The variance of an error that is within kRight with this probability, above 0.
SHARED_FN float varianceWhereRight(float probability)
{
    const float square = probability * probability;
    return 0.5f * kRight * kRight * (1.0f - square) / square;
}

SHARED_END

#endif
