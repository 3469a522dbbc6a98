#ifndef RELAMP_PAINT_PRIOR_SHARED_H
#define RELAMP_PAINT_PRIOR_SHARED_H

#include "albedo/fill.shared.h"

SHARED_BEGIN

SHARED_CONST kPaintSpread = 0.4f;     // of log albedo, of what is of one colour on one surface
SHARED_CONST kOtherBrightness = 0.6f; // of log luminance: more is rather another paint
SHARED_CONST kOtherHue = 0.2f;        // of log colour without brightness, likewise
SHARED_CONST kSureOfPaint = 7e-4f;    // variance: below, an albedo hardly moves

SHARED_FN vec3 logOfPaint(vec3 albedo)
{
    return log(max(albedo, vec3(kBlackPaint)));
}

// How far two log albedos that are `off` from each other can be of one paint, 0..1, where their
// brightness errs by `variance`. Errors of light are hardly coloured.
SHARED_FN float likenessOfPaints(vec3 off, float variance)
{
    const float brighter = luminance(off);
    const vec3 hue = off - vec3(brighter);
    const float otherHue = 0.5f * dot(hue, hue) / (kOtherHue * kOtherHue);
    const float otherBrightness =
        brighter * brighter / (kOtherBrightness * kOtherBrightness + variance);
    return 1.0f / ((1.0f + otherHue) * (1.0f + otherBrightness));
}

// The albedo that is likeliest by its own light and by the paint around, for what of the channels
// is not burnt out. Where hardly any light falls, all is as likely as the division has it
// (dividedByShading()). `variance`: of the logarithm of its light.
SHARED_FN vec3 drawnToPaint(vec3 own, vec3 around, float variance, vec3 burntOut, vec3 shading,
                            float darkest)
{
    if (variance < kSureOfPaint) return own;
    const float share = variance / (variance + kPaintSpread * kPaintSpread);
    const vec3 off = logOfPaint(around) - logOfPaint(own);
    const vec3 drawn = own * exp(share * likenessOfPaints(off, variance) * off);
    const float isLit = min(brightestChannel(shading) / darkest, 1.0f);
    return own + isLit * (vec3(1.0f) - burntOut) * (drawn - own);
}

SHARED_END

#endif
