#ifndef RELAMP_FILL_SHARED_H
#define RELAMP_FILL_SHARED_H

#include "albedo/divide.shared.h"
#include "image/texture_noise.shared.h"

#ifdef __cplusplus
#include <glm/ext/vector_bool3.hpp>
#include <glm/vector_relational.hpp>
#endif

SHARED_BEGIN

SHARED_CONST kBlackPaint = 1e-3f;
SHARED_CONST kFaintestShading = 1e-4f;
SHARED_CONST kDarkestPaint = 0.02f; // in any channel
SHARED_CONST kOtherPaint = 0.4f;    // in the logarithm: half as bright again, or two thirds

// What noise of a texture can make of an albedo. `white`: radiance that its white stands for.
SHARED_FN vec3 noiseOfAlbedo(vec3 shading, float lack, vec3 white, TextureNoise noise)
{
    return radianceOfBlack(noise) * white / max(lack * shading, vec3(kFaintestShading));
}

// How far noise of the texture hides channels of what it shows. Where hardly any light falls, all
// is as likely as the division has it (dividedByShading()).
SHARED_FN vec3 hiddenWhereLit(vec3 shown, vec3 shading, float darkest, TextureNoise noise)
{
    return min(brightestChannel(shading) / darkest, 1.0f) * hiddenShares(shown, noise);
}

// What is not known of a texel's channels.
struct UnknownChannels
{
    vec3 burntOut; // 0..1, how likely: what several photos were blended to may be in part
    vec3 hidden;   // 0..1, how far by noise of the texture
    vec3 noise;    // of the albedo, at most, where it is hidden
    bvec3 isUnlit;
};

// Albedo of what came out whiter than paper: it gets light that was not found, of any hue, so it
// counts as the share of its light that was found, at most 1 / lack, and the surface around for the
// rest. `own`: under `lack` times the shading (lightThatLacks()).
SHARED_FN vec3 believedUnderLack(vec3 own, float lack, vec3 around, vec3 burntOut)
{
    const float unknown = 1.0f - 1.0f / lack;
    return own + unknown * (vec3(1.0f) - burntOut) * (max(around, vec3(kDarkestPaint)) - own);
}

// How many times the light found that makes of each channel: `own` becomes `believed`.
SHARED_FN vec3 lackOfChannels(vec3 own, float lack, vec3 believed)
{
    return lack * max(own, vec3(kBlackPaint)) / max(believed, vec3(kBlackPaint));
}

SHARED_FN bool isAnyUnknown(UnknownChannels unknown)
{
    return any(unknown.isUnlit) || unknown.burntOut != vec3(0.0f) || unknown.hidden != vec3(0.0f);
}

// How far the colour around can be that of a paint which is `scale` times as bright, 0..1.
SHARED_FN float likenessOfPaint(float scale)
{
    const float off = log(max(scale, 1e-6f)) / kOtherPaint;
    return 1.0f / (1.0f + off * off);
}

// Albedo of a texel of which channels are burnt out, hidden or unlit. What a burnt-out channel
// shows is the least that it can be, and the less sure the more light lacks: `own` is under `lack`
// times the shading (lightThatLacks()). `around`: of the surface.
SHARED_FN vec3 filledAlbedo(vec3 own, float lack, vec3 around, UnknownChannels unknown)
{
    const vec3 least = own / lack;
    float whole = 0.0f;
    float theirs = 0.0f;
    float count = 0.0f;
    float brightest = 0.0f; // of what is burnt out
    float most = 1.0f;      // times around, that is as bright
    for (int c = 0; c < 3; ++c) {
        const float isWhole =
            unknown.isUnlit[c] ? 0.0f : (1.0f - unknown.burntOut[c]) * (1.0f - unknown.hidden[c]);
        whole += isWhole * own[c];
        theirs += isWhole * around[c];
        count += isWhole;
        if (unknown.isUnlit[c]) continue;
        brightest = max(brightest, least[c]);
        most = max(most, least[c] / max(around[c], kBlackPaint));
    }
    // One whole channel tells the paint, a part of one in part: a step would part two engines that
    // round differently.
    const float told = theirs > 0.0f ? min(count, 1.0f) : 0.0f;
    const float ofWhole = whole / max(theirs, 1e-6f);
    const float scale = 1.0f + told * (ofWhole - 1.0f);
    const float like =
        likenessOfPaint(most) + told * (likenessOfPaint(ofWhole) - likenessOfPaint(most));
    const float grey = brightest + told * (whole / max(count, 1e-6f) - brightest);
    const vec3 theirColor = min(scale * around, vec3(kWhitePaint));
    const vec3 guess = grey + like * (theirColor - grey);
    // What is burnt out is raised alike, as far as that can be the paint around: channel by
    // channel, white by warm light would come out blue.
    float needed = 1.0f;
    for (int c = 0; c < 3; ++c)
        if (!unknown.isUnlit[c])
            needed = max(needed, unknown.burntOut[c] * least[c] / max(guess[c], kBlackPaint));
    const vec3 raised = guess * (1.0f + likenessOfPaint(needed) * (needed - 1.0f));
    vec3 filled = own;
    for (int c = 0; c < 3; ++c) {
        if (unknown.isUnlit[c]) {
            filled[c] = theirColor[c];
            continue;
        }
        filled[c] += unknown.burntOut[c] * (min(max(raised[c], least[c]), kWhitePaint) - filled[c]);
        const float seen = clamp(max(theirColor[c], kDarkestPaint),
                                 max(own[c] - unknown.noise[c], 0.0f), own[c] + unknown.noise[c]);
        filled[c] += unknown.hidden[c] * (seen - filled[c]);
    }
    return filled;
}

SHARED_END

#endif
