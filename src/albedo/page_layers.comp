#version 460
#extension GL_GOOGLE_include_directive : require

#include "albedo/confidence.shared.h"
#include "albedo/fill.shared.h"
#include "albedo/page_layers.gpu.h"
#include "albedo/page_layers.shared.h"
#include "albedo/paint_prior.shared.h"
#include "base/radiometry.shared.h"
#include "lights/shining.shared.h"
#include "shading/enclosed_texels.shared.h"
#include "shading/tempering.shared.h"

ARGUMENTS(PageLayersArguments)

struct Shading
{
    vec3 direct;
    vec3 indirect;
};

bool isSo(uint flag)
{
    return (arguments.flags & flag) != 0;
}

// With some of the light around at the rim of what is enclosed.
Shading shadingFound(uint i, vec4 rim, vec3 radiance)
{
    Shading shading;
    shading.direct = 1.0 / kPi * halves(arguments.direct.at[i]).rgb;
    shading.indirect = 1.0 / kPi * halves(arguments.indirect.at[i]).rgb;
    if (rim.w <= 0.0) return shading;
    const float share =
        shareOfRim(luminance(radiance), luminance(shading.direct + shading.indirect),
                   luminance(rim.rgb), rim.w);
    shading.direct *= 1.0 - share;
    shading.indirect += share * (rim.rgb - shading.indirect);
    return shading;
}

// As far as it is believed.
Shading shadingOf(uint i, vec4 rim, vec3 radiance)
{
    Shading shading = shadingFound(i, rim, radiance);
    const vec4 tempering = arguments.constants.at[0].tempering;
    const vec3 times = temperedBy(shading.direct + shading.indirect, tempering.rgb, tempering.w);
    shading.direct *= times;
    shading.indirect *= times;
    return shading;
}

struct Filled
{
    vec3 albedo;
    vec3 lack; // its light, times the shading
};

// What is burnt out, hidden by noise, whiter than paper or in doubtful light, and if asked for what
// is unlit, follows the surface around.
Filled filled(vec3 albedo, float lack, vec3 shown, vec3 shading, vec3 around, vec3 white,
              float doubt)
{
    UnknownChannels unknown;
    unknown.burntOut = burntOutShares(shown, isSo(kClips));
    unknown.hidden =
        hiddenWhereLit(shown, shading, arguments.darkest, arguments.constants.at[0].noise);
    unknown.noise = noiseOfAlbedo(shading, lack, white, arguments.constants.at[0].noise);
    unknown.isUnlit = lessThan(shading, vec3(isSo(kFillsUnlit) ? arguments.darkest : 0.0));
    if (!isSo(kFills) || (!isAnyUnknown(unknown) && lack == 1.0 && doubt < kSureOfPaint))
        return Filled(albedo, vec3(lack));
    const vec3 believed = drawnToPaint(believedUnderLack(albedo, lack, around, unknown.burntOut),
                                       around, doubt, unknown.burntOut, shading, arguments.darkest);
    return Filled(filledAlbedo(believed, lack, around, unknown),
                  lackOfChannels(albedo, lack, believed));
}

void storeLight(uint pixel, Shading shading, vec3 lack)
{
    arguments.directOut.at[pixel] = packedHalves(vec4(lack * shading.direct, 1.0));
    arguments.indirectOut.at[pixel] = packedHalves(vec4(lack * shading.indirect, 1.0));
}

void main()
{
    const uint i = threadIndex();
    if (i >= arguments.count) return;
    const uint surfel = arguments.surfel.at[i];
    const uint pixel = arguments.pixel.at[i];
    const bool clips = isSo(kClips);
    const vec3 radiance = halves(arguments.radiance.at[i]).rgb;
    const vec4 ofSurfel = arguments.white.at[surfel];
    const vec3 white = ofSurfel.rgb;
    const vec3 shown = radiance / white;
    const vec4 rim = arguments.rims.at[surfel];
    const Shading shading = shadingOf(i, rim, radiance);
    const vec3 total = shading.direct + shading.indirect;
    const vec3 divided = dividedByShading(radiance, total, arguments.darkest);
    const float lack = lightThatLacks(divided);
    const vec4 around = arguments.around.at[surfel];
    if (around.w > 0.0 && (isEmitting(shown, clips, arguments.constants.at[0].threshold) ||
                           isGlowing(radiance, around.w - kOfLamp))) {
        storeLight(pixel, shading, vec3(lack));
        arguments.albedoOut.at[pixel] = packedHalves(vec4(vec3(kAlbedoOfFixtures), 1.0));
        arguments.ratingOut.at[pixel] = kDoubtShines << 8; // confidence is 0
        return;
    }
    // What is enclosed has its light by the rim.
    const float doubt = rim.w > 0.0 ? 0.0 : ofSurfel.w;
    const Filled result = filled(divided / lack, lack, shown, total, around.rgb, white, doubt);
    storeLight(pixel, shading, result.lack);
    arguments.albedoOut.at[pixel] = packedHalves(vec4(result.albedo, 1.0));
    const vec4 trust = arguments.trust.at[surfel];
    const float hidden = hiddenShare(brightestChannel(shown), arguments.constants.at[0].noise);
    const float burntOut = brightestChannel(burntOutShares(shown, clips));
    const Rated rated = ratedAlbedo(radiance, burntOut, total, arguments.darkest, trust, hidden);
    arguments.ratingOut.at[pixel] = confidenceByte(rated.value) | doubtOf(rated) << 8;
}
