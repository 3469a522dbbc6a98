#ifndef RELAMP_BIWEIGHT_SHARED_H
#define RELAMP_BIWEIGHT_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

// Tukey's biweight: a bell that ends at q = 1. q is a squared distance over a squared reach.
SHARED_FN float biweight(float q)
{
    const float inside = max(1.0f - q, 0.0f);
    return inside * inside;
}

SHARED_END

#endif
