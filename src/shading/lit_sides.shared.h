#ifndef RELAMP_LIT_SIDES_SHARED_H
#define RELAMP_LIT_SIDES_SHARED_H

#include "base/radiometry.shared.h"
#include "image/burnt_out.shared.h"

SHARED_BEGIN

const int kLitSidesRounds = 4;           // until what is burnt out and backs are settled
const int kExcessSmoothings = 3;         // of light from what sends more than white
SHARED_CONST kLikelyNoise = 1.5f;        // standard errors
SHARED_CONST kMostRadiance = 10.0f;      // of a wall beside a lamp
SHARED_CONST kHardlyOut = 0.8f;          // a mean: below, hardly a texel of it is burnt out
SHARED_CONST kAlbedoOfTheUnknown = 0.7f; // of a surfel that is burnt out all over

// Albedo of what shows `radiance` under this irradiance.
SHARED_FN vec3 albedoUnder(vec3 irradiance, vec3 radiance)
{
    return clamp(kPi * radiance / max(irradiance, vec3(1e-4f)), 0.02f, 0.95f);
}

// What a burnt-out wall sends that shows this much, the mean of its burnt-out texels: that in
// channels that are not burnt out themselves, and in others not less. `white`: radiance that white
// of the texture stands for.
SHARED_FN vec3 burntOutRadiance(vec3 albedo, vec3 irradiance, vec3 shown, vec3 white)
{
    const vec3 ofWhite = shown / max(white, vec3(kFaintest));
    const vec3 isOut = clamp((ofWhite - kHardlyOut) / (kBurntOut - kHardlyOut), 0.0f, 1.0f);
    const vec3 most = mix(shown, max(shown, vec3(kMostRadiance)), isOut);
    return clamp(albedo * irradiance / kPi, shown, most);
}

// How far a value is drawn towards the mean around it: all the way where that may be its noise.
// `step`: the luminance of how far the mean is away in each channel; another colour that is as
// bright is no noise. `squaredNoise`: of its standard error.
SHARED_FN float shareOfNoise(float step, float squaredNoise)
{
    const float variance = kLikelyNoise * kLikelyNoise * squaredNoise;
    return variance / max(step * step, variance + 1e-12f);
}

SHARED_END

#endif
