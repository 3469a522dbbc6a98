#ifndef RELAMP_PAGE_LAYERS_GPU_H
#define RELAMP_PAGE_LAYERS_GPU_H

#include "gpu/compute.h"
#include "image/texture_noise.shared.h"

SHARED_BEGIN

SHARED_CONST kOfLamp = 1.0f; // in `around`
const uint kClips = 1u;      // Image::clipsAtWhite
const uint kFills = 2u;      // `around` is known
const uint kFillsUnlit = 4u; // what `darkest` is not reached by is filled, too

struct PageConstants
{
    TextureNoise noise;
    float threshold; // luminance from which a texel of a lamp shines
    vec4 tempering;  // factor, power
};
SHARED_ARRAY(PagesConstants, PageConstants)

// A thread a texel. Pictures are halves; the last is 1 where a texel is.
struct PageLayersArguments
{
    Uvec2s radiance; // of texels, halves
    Uvec2s direct;   // irradiance, halves
    Uvec2s indirect;
    Uints surfel;
    Uints pixel;
    Vec4s rims;   // of surfels: shading around enclosed ones, and its albedo or 0
    Vec4s trust;  // seen, front, edges, proven
    Vec4s around; // albedo for what is burnt out; w: 0 where it holds no part of a lamp, else
                  // kOfLamp and the luminance from which what is not burnt out shines
    Vec4s white;  // radiance that white of the texture stands for; w: SolvedTexels::doubt
    Uvec2s albedoOut;
    Uvec2s directOut;
    Uvec2s indirectOut;
    Uints ratingOut;          // of pixels: confidence 0..255 and 256 times the doubt
    PagesConstants constants; // of the page alone
    float darkest;            // shading
    uint flags;               // the sum of what is so:
    uint count;               // of texels
};

SHARED_END

#endif
