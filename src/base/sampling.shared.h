#ifndef RELAMP_SAMPLING_SHARED_H
#define RELAMP_SAMPLING_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

// A number in [0, 1) that looks random but is the index's own.
SHARED_FN float hashedShift(uint index, uint salt)
{
    uint h = index * 0x9e3779b9u + salt * 0x85ebca6bu;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    h = h ^ (h >> 16);
    return float(h >> 8) * (1.0f / 16777216.0f);
}

// The same of a seed; seed 1 leaves it as it is.
SHARED_FN float seededShift(uint seed, uint index, uint salt)
{
    return hashedShift(index, salt + 256u * (seed - 1u));
}

// Point i of the R2 sequence (Roberts 2018), shifted; fills the unit square evenly at any length.
SHARED_FN vec2 evenPoint(float i, vec2 shift)
{
    return fract(shift + i * vec2(0.7548776662f, 0.5698402910f));
}

// sin(2 pi w) for w in -0.25..0.25, to 1e-7: the sine's series.
SHARED_FN float sineOfTurn(float w)
{
    const float x = 6.28318531f * w;
    const float x2 = x * x;
    const float high = 2.75573192e-6f - 2.50521084e-8f * x2;
    return x * (1.0f + x2 * (-1.66666667e-1f +
                             x2 * (8.33333333e-3f + x2 * (-1.98412698e-4f + x2 * high))));
}

// (cos, sin) of 2 pi `turn`, turn in [0, 1]: cheaper than these two, where they are by the million.
SHARED_FN vec2 onCircle(float turn)
{
    const float y = turn - 0.5f;
    const float far = abs(y);
    const float sine = sineOfTurn(0.25f - abs(far - 0.25f));
    return vec2(-sineOfTurn(0.25f - far), y < 0.0f ? sine : -sine);
}

// Direction around `normal` with density cos / pi; u in [0, 1)^2.
SHARED_FN vec3 cosineDirection(vec3 normal, vec2 u)
{
    // Duff et al. 2017, "Building an Orthonormal Basis, Revisited"
    const float s = normal.z < 0.0f ? -1.0f : 1.0f;
    const float a = -1.0f / (s + normal.z);
    const float b = normal.x * normal.y * a;
    const vec3 tangent = vec3(1.0f + s * normal.x * normal.x * a, s * b, -s * normal.x);
    const vec3 bitangent = vec3(b, s + normal.y * normal.y * a, -normal.y);
    const vec2 side = sqrt(u.x) * onCircle(u.y);
    const float up = sqrt(max(1.0f - u.x, 0.0f));
    return side.x * tangent + side.y * bitangent + up * normal;
}

// Direction with the same density all around.
SHARED_FN vec3 evenDirection(vec2 u)
{
    const float z = 1.0f - 2.0f * u.x;
    const vec2 side = sqrt(max(1.0f - z * z, 0.0f)) * onCircle(u.y);
    return vec3(side.x, side.y, z);
}

SHARED_END

#endif
