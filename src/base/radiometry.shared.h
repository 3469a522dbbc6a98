#ifndef RELAMP_RADIOMETRY_SHARED_H
#define RELAMP_RADIOMETRY_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

SHARED_CONST kPi = 3.14159265f;
SHARED_CONST kSunHalfAngle = 0.00465f; // rad, of its disc as seen from the earth
SHARED_CONST kWhitestPaper = 0.9f; // albedo: no matte surface is whiter; bounds light from below
SHARED_CONST kWhitePaint = 0.87f;  // albedo: the most that is given; makers have 0.82..0.92
SHARED_CONST kUsualPaper = 0.35f;  // albedo: of a room's surfaces, mean of logarithms
SHARED_CONST kFaintest = 1e-4f;    // radiance or irradiance, of the texture's white; less is black

// Rec. 709 luminance of linear RGB.
SHARED_FN float luminance(vec3 rgb)
{
    return dot(rgb, vec3(0.2126f, 0.7152f, 0.0722f));
}

SHARED_FN float logOfLight(float light)
{
    return log(max(light, kFaintest));
}

SHARED_END

#endif
