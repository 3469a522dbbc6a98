#ifndef RELAMP_DIVIDE_SHARED_H
#define RELAMP_DIVIDE_SHARED_H

#include "base/shared.h"
#include "image/burnt_out.shared.h"

SHARED_BEGIN

SHARED_CONST kWhitestPaper = 0.9f;     // albedo: no matte surface is whiter
SHARED_CONST kLeastOfBrightest = 0.2f; // of the brightest channel of a shading; less is noise

// What a matte surface of albedo rho under shading S = E / pi shows is rho S. Here S is raised
// before it divides until its brightest channel reaches `darkest`, for below it noise is all there
// is: all channels alike, which keeps its hue, but those that hardly hold any light.
SHARED_FN vec3 dividedByShading(vec3 radiance, vec3 shading, float darkest)
{
    const vec3 some = shading + 1e-6f; // what is black is raised as grey
    const float brightest = brightestChannel(some);
    const float raised = max(darkest / brightest, 1.0f);
    return radiance / (raised * max(some, vec3(kLeastOfBrightest * brightest)));
}

// What came out whiter than paper got more light than was known: how many times as much, at least.
SHARED_FN float lightThatLacks(vec3 albedo)
{
    return max(brightestChannel(albedo) / kWhitestPaper, 1.0f);
}

SHARED_END

#endif
