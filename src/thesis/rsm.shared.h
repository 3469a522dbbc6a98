#ifndef RELAMP_RSM_SHARED_H
#define RELAMP_RSM_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

// Direction through point (u, v) in [-1, 1]^2 of a cube's face; faces 0..5 look along +x -x +y -y
// +z -z.
SHARED_FN vec3 cubeDirection(int face, float u, float v)
{
    const float side = (face & 1) == 0 ? 1.0f : -1.0f;
    if (face < 2) return normalize(vec3(side, u, v));
    if (face < 4) return normalize(vec3(u, side, v));
    return normalize(vec3(u, v, side));
}

// Solid angle of the pixel at (u, v) of a face of n x n pixels.
SHARED_FN float cubePixelSolidAngle(float u, float v, float n)
{
    const float squared = 1.0f + u * u + v * v;
    return 4.0f / (n * n * squared * sqrt(squared));
}

SHARED_END

#endif
