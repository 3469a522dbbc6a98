#ifndef RELAMP_DIVIDE_SHARED_H
#define RELAMP_DIVIDE_SHARED_H

#include "base/radiometry.shared.h"
#include "base/shared.h"
#include "image/burnt_out.shared.h"

SHARED_BEGIN

SHARED_CONST kLeastOfBrightest = 0.2f; // of the brightest channel of a shading; less is noise

// What a matte surface of albedo rho under shading S = E / pi shows is rho S. Of that hardly
// anything is left where S is below `darkest` in its brightest channel: the darker, the more likely
// is the usual paper. What still shows more than that would gets more light than was found: it is
// as if the shading were `darkest`.
SHARED_FN vec3 dividedByShading(vec3 radiance, vec3 shading, float darkest)
{
    const vec3 some = shading + 1e-6f; // what is black is so in all channels
    const float brightest = brightestChannel(some);
    const vec3 shown = radiance / max(some, vec3(kLeastOfBrightest * brightest));
    const float known = min(brightest / darkest, 1.0f);
    const float lost = (1.0f - known) * (1.0f - known);
    const vec3 likely = (1.0f - lost) * shown + lost * kUsualPaper;
    const float most = max(known * brightestChannel(shown), kUsualPaper);
    const float less = min(most / max(brightestChannel(likely), 1e-6f), 1.0f);
    return known < 1.0f ? less * likely : shown;
}

// What came out whiter than paper got more light than was known: how many times as much, at least.
SHARED_FN float lightThatLacks(vec3 albedo)
{
    return max(brightestChannel(albedo) / kWhitePaint, 1.0f);
}

SHARED_END

#endif
