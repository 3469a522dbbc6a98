#ifndef RELAMP_TEXTURE_NOISE_SHARED_H
#define RELAMP_TEXTURE_NOISE_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

SHARED_CONST kHueOfPaint = 0.4f;    // log: what the channels of a place differ from those around by
SHARED_CONST kHardlyHidden = 0.02f; // of a channel: less is nothing

// How unsure a page's bytes leave its light. With t the linear value of a texture and L the
// radiance that it shows, log L = offset + slope log t in dark places, where it matters, and t has
// the relative deviation max(toe / t, steep / t^(1/2.4)), as sRGB has.
struct TextureNoise
{
    float toe; // 0: none
    float steep;
    float offset;
    float slope;
    float visibleFrom; // radiance, from which on nothing is hidden
};

// How far noise hides what a channel is, 0..1: of its variance with that of paint.
SHARED_FN float hiddenShare(float radiance, TextureNoise noise)
{
    if (radiance >= noise.visibleFrom) return 0.0f;
    const float texture = exp((log(max(radiance, 1e-9f)) - noise.offset) / noise.slope);
    const float deviation =
        noise.slope * max(noise.toe / texture, noise.steep * pow(texture, -1.0f / 2.4f));
    const float paint = kHueOfPaint / deviation;
    const float share = 1.0f / (1.0f + paint * paint);
    return max(share - kHardlyHidden, 0.0f) / (1.0f - kHardlyHidden);
}

SHARED_FN vec3 hiddenShares(vec3 radiance, TextureNoise noise)
{
    return vec3(hiddenShare(radiance.x, noise), hiddenShare(radiance.y, noise),
                hiddenShare(radiance.z, noise));
}

// Radiance that black may be: two standard deviations.
SHARED_FN float radianceOfBlack(TextureNoise noise)
{
    return noise.toe > 0.0f ? exp(noise.offset + noise.slope * log(2.0f * noise.toe)) : 0.0f;
}

SHARED_END

#endif
