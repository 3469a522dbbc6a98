#ifndef RELAMP_CONFIDENCE_SHARED_H
#define RELAMP_CONFIDENCE_SHARED_H

#include "albedo/divide.shared.h"
#include "image/burnt_out.shared.h"

SHARED_BEGIN

SHARED_CONST kWellLit = 4.0f;   // times `darkest`
SHARED_CONST kMuchLacks = 2.0f; // times the shading

// Doubt, as numbers.
const uint kDoubtNone = 0u;
const uint kDoubtClipped = 1u;
const uint kDoubtShines = 2u;
const uint kDoubtUnlit = 3u;
const uint kDoubtUnseen = 4u;
const uint kDoubtBackFace = 5u;
const uint kDoubtPenumbra = 6u;
const uint kDoubtWhiterThanPaper = 7u;
const uint kDoubtShared = 8u;
const uint kDoubtUnproven = 9u;

struct Rated
{
    float value; // 0..1
    float least; // factor of it
    uint doubt;  // whose that is
};

SHARED_FN Rated lessBy(Rated rated, float left, uint doubt)
{
    rated.value *= left;
    if (left < rated.least) {
        rated.least = left;
        rated.doubt = doubt;
    }
    return rated;
}

// How far an albedo can be believed. `burntOut`: how likely any channel is. `trust` in the shading:
// SurfelTrust's seen, front, edges, proven. `hidden`: how far noise hides its brightest channel.
SHARED_FN Rated ratedAlbedo(vec3 radiance, float burntOut, vec3 shading, float darkest, vec4 trust,
                            float hidden)
{
    const float lack = lightThatLacks(dividedByShading(radiance, shading, darkest));
    const float weakest = min(shading.x, min(shading.y, shading.z));
    Rated rated;
    rated.value = 1.0f;
    rated.least = 1.0f;
    rated.doubt = kDoubtNone;
    rated = lessBy(rated, 1.0f - burntOut, kDoubtClipped);
    rated = lessBy(rated, ramp(darkest, kWellLit * darkest, weakest), kDoubtUnlit);
    rated = lessBy(rated, 1.0f - hidden, kDoubtUnlit);
    rated = lessBy(rated, trust.x, kDoubtUnseen);
    rated = lessBy(rated, trust.y, kDoubtBackFace);
    rated = lessBy(rated, trust.z, kDoubtPenumbra);
    rated = lessBy(rated, ramp(kMuchLacks, 1.0f, lack), kDoubtWhiterThanPaper);
    return lessBy(rated, trust.w, kDoubtUnproven);
}

SHARED_FN uint confidenceByte(float value)
{
    return uint(round(255.0f * value));
}

// What speaks most against it; nothing from one half on.
SHARED_FN uint doubtOf(Rated rated)
{
    return confidenceByte(rated.value) >= 128u ? kDoubtNone : rated.doubt;
}

SHARED_END

#endif
