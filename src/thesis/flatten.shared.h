#ifndef RELAMP_FLATTEN_SHARED_H
#define RELAMP_FLATTEN_SHARED_H

#include "base/biweight.shared.h"
#include "base/shared.h"

SHARED_BEGIN

// Joint bilateral weight (Petschnigg et al. 2004) of a sample on the surface: near in space and
// near in colour. Colours are square roots of radiance, where equal steps look about equal.
SHARED_FN float bilateralWeight(vec3 way, vec3 colorStep, float perReachSquared,
                                float perRangeSquared)
{
    return biweight(dot(way, way) * perReachSquared) *
           biweight(dot(colorStep, colorStep) * perRangeSquared);
}

// What is filtered: square roots of radiance up to white.
SHARED_FN vec3 filteredAs(vec3 radiance)
{
    return sqrt(min(radiance, vec3(1.0f)));
}

const int kFlattenBins = 8; // of brightness, in equal steps of its square root

SHARED_FN int brightnessBin(vec3 root)
{
    const float bins = float(kFlattenBins);
    const float brightness = 0.25f * root.x + 0.5f * root.y + 0.25f * root.z;
    return int(clamp(brightness * bins, 0.0f, bins - 1.0f));
}

SHARED_END

#endif
