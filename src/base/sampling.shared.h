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

// Direction around `normal` with density cos / pi; u in [0, 1)^2.
SHARED_FN vec3 cosineDirection(vec3 normal, vec2 u)
{
    // Duff et al. 2017, "Building an Orthonormal Basis, Revisited"
    const float s = normal.z < 0.0f ? -1.0f : 1.0f;
    const float a = -1.0f / (s + normal.z);
    const float b = normal.x * normal.y * a;
    const vec3 tangent = vec3(1.0f + s * normal.x * normal.x * a, s * b, -s * normal.x);
    const vec3 bitangent = vec3(b, s + normal.y * normal.y * a, -normal.y);
    const float radius = sqrt(u.x);
    const float angle = 6.28318531f * u.y;
    const float up = sqrt(max(1.0f - u.x, 0.0f));
    return normalize(radius * cos(angle) * tangent + radius * sin(angle) * bitangent + up * normal);
}

// Direction with the same density all around.
SHARED_FN vec3 evenDirection(vec2 u)
{
    const float z = 1.0f - 2.0f * u.x;
    const float radius = sqrt(max(1.0f - z * z, 0.0f));
    const float angle = 6.28318531f * u.y;
    return vec3(radius * cos(angle), radius * sin(angle), z);
}

SHARED_END

#endif
