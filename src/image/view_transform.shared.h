#pragma once

#include "base/shared.h"

SHARED_BEGIN

// ---- AgX: Sobotka, AgX (github.com/sobotka/AgX-S2O3), 2022

SHARED_CONST kMiddleGrey = 0.18f;
SHARED_CONST kStopsBelow = 10.0f; // of middle grey; what is darker is black
SHARED_CONST kStopsAbove = 6.5f;  // what is brighter is white
SHARED_CONST kInset = 0.2f;       // how far the primaries move out, so that colours move in

// X + Y + Z of a Rec. 709 primary as a share of white's, times each: with it, mixing a colour with
// its mean moves it on a straight line towards white in the chromaticity diagram.
SHARED_FN float agxMean(vec3 rgb)
{
    return dot(vec3(0.2120f, 0.3922f, 0.3958f), rgb);
}

// AgX's matrix: primaries 1 / (1 - inset) as far from white are what the curve works on.
SHARED_FN vec3 agxInset(vec3 rgb)
{
    return (1.0f - kInset) * rgb + kInset * agxMean(rgb);
}

SHARED_FN vec3 agxOutset(vec3 rgb)
{
    return (rgb - kInset * agxMean(rgb)) / (1.0f - kInset);
}

// One half of a sigmoid: from the pivot, where the slope is 2, to (reachX, 0.5).
SHARED_FN float agxHalfSigmoid(float x, float reachX, float power)
{
    const float slope = 2.0f;
    const float scale =
        pow(pow(slope * reachX, -power) * (pow(4.0f * reachX, power) - 1.0f), -1.0f / power);
    const float term = slope * x / scale;
    return scale * term / pow(1.0f + pow(term, power), 1.0f / power);
}

// From the share of the range in stops to the share of a display's range, of exponent 2.2.
SHARED_FN float agxCurve(float share)
{
    const float pivot = kStopsBelow / (kStopsBelow + kStopsAbove);
    return share < pivot ? 0.5f - agxHalfSigmoid(pivot - share, pivot, 3.0f)
                         : 0.5f + agxHalfSigmoid(share - pivot, 1.0f - pivot, 3.25f);
}

// Where a channel lies in the range that AgX shows, 0..1.
SHARED_FN float agxShare(float light)
{
    const float stops = log2(max(light, 1e-10f) / kMiddleGrey);
    return clamp((stops + kStopsBelow) / (kStopsBelow + kStopsAbove), 0.0f, 1.0f);
}

// ---- ACES: Hill's fit of its reference rendering and sRGB output transforms, 2017
// (github.com/TheRealMJP/BakingLab, ACES.hlsl)

SHARED_FN vec3 acesOf(vec3 rgb)
{
    // Rec. 709 to the rendering primaries, with the saturation that the reference rendering takes.
    const vec3 into = vec3(dot(vec3(0.59719f, 0.35458f, 0.04823f), rgb),
                           dot(vec3(0.07600f, 0.90834f, 0.01566f), rgb),
                           dot(vec3(0.02840f, 0.13383f, 0.83777f), rgb));
    const vec3 v = (into * (into + 0.0245786f) - 0.000090537f) /
                   (into * (0.983729f * into + 0.4329510f) + 0.238081f);
    return vec3(dot(vec3(1.60475f, -0.53108f, -0.07367f), v),
                dot(vec3(-0.10208f, 1.10813f, -0.00605f), v),
                dot(vec3(-0.00327f, -0.07276f, 1.07602f), v));
}

SHARED_CONST kBrightest = 1e6f; // beyond it every view is white, and squares are still floats

SHARED_END
