#pragma once

#include "base/shared.h"

SHARED_BEGIN

// Tukey's biweight: a bell that ends at q = 1. q is a squared distance over a squared reach.
SHARED_FN float biweight(float q)
{
    const float inside = max(1.0f - q, 0.0f);
    return inside * inside;
}

// Joint bilateral weight (Petschnigg et al. 2004) of a sample on the surface: near in space and
// near in colour. Colours are square roots of radiance, where equal steps look about equal.
SHARED_FN float bilateralWeight(vec3 way, vec3 colorStep, float perReachSquared,
                                float perRangeSquared)
{
    return biweight(dot(way, way) * perReachSquared) *
           biweight(dot(colorStep, colorStep) * perRangeSquared);
}

SHARED_END
