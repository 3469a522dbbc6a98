#ifndef RELAMP_LAMP_PATCHES_SHARED_H
#define RELAMP_LAMP_PATCHES_SHARED_H

#include "base/radiometry.shared.h"
#include "shading/area_direct.shared.h"

SHARED_BEGIN

const int kMostDepth = 16; // of a tree of patches

// How much of a patch's light its parts are asked for, 0..1: none from afar, all from near by.
SHARED_FN float shareOfParts(float squared, float farSquared, float perRamp)
{
    return clamp((farSquared - squared) * perRamp, 0.0f, 1.0f);
}

// Irradiance a radiance of a patch of area 1 that faces `facing` in the mean and whose points lie
// `spread` (m^2, variance along each of its two axes) around its middle: the form factor of a point
// and the second order of what it is off by. For places some of its sizes away.
SHARED_FN float wideFormFactor(vec3 way, vec3 normal, vec3 facing, float spread)
{
    const float squared = max(dot(way, way), 1e-12f);
    const float received = dot(way, normal);
    const float sent = -dot(way, facing);
    const float perSquared = 1.0f / squared;
    const float turned = dot(normal, facing);
    const float second = 4.0f * sent * (received - turned * sent) -
                         12.0f * received * sent * sent * sent * perSquared;
    const float factor = (received * sent + spread * second * perSquared) * perSquared * perSquared;
    return received > 0.0f && sent > 0.0f ? max(factor, 0.0f) : 0.0f;
}

// The same of a patch that nothing smaller stands for, near by: on its axis that is a disc's.
SHARED_FN float nearFormFactor(vec3 way, vec3 normal, vec3 facing, float area)
{
    return patchFormFactor(way, normal, facing, area / kPi);
}

SHARED_END

#endif
