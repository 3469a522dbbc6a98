#ifndef RELAMP_GATHER_SHARED_H
#define RELAMP_GATHER_SHARED_H

#include "base/radiometry.shared.h"

SHARED_BEGIN

// Of `rays` cosine-distributed rays each one's part of the irradiance, at radiance 1.
SHARED_FN float irradiancePerRay(float rays)
{
    return kPi / rays;
}

// Numerics.
// Of the variance of random rays, what even ones have: measured between seeds.
SHARED_CONST kVarianceOfEven = 0.42f;

// Standard error of the luminance of an irradiance by that many rays. `sum` is of the luminance of
// what they met, `squares` of its squares.
SHARED_FN float noiseOfRays(float sum, float squares, float rays)
{
    const float mean = sum / rays;
    return kPi * sqrt(kVarianceOfEven * max(squares / rays - mean * mean, 0.0f) / rays);
}

SHARED_END

#endif
