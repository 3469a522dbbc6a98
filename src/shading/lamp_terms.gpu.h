#ifndef RELAMP_LAMP_TERMS_GPU_H
#define RELAMP_LAMP_TERMS_GPU_H

#include "gpu/compute.h"

SHARED_BEGIN

// Irradiance that lamps bring to places at a radiance of 1 each, times a scale: halves of two lamps
// in a number, [pair of lamps][place].
struct LampTerms
{
    Uints terms;
    Vec4s radiance; // of lamps over their scale, two a pair
    uint pairs;
    uint count; // of places
};

struct LampTermsArguments
{
    Uvec4s site; // of texels
    Uints surfel;
    Vec4s position; // of surfels
    Uints firstNeighbor;
    Uints neighbor;
    Uvec4s patches;  // three of each, see patchOf()
    Uints seen;      // of surfels, bytes: kSeesNothing .. kSeesSome
    Uints shares;    // of probes, bytes
    Vec4s probes;    // where they are
    Uvec2s probesOf; // of surfels: their first probe, and its reach as bits of a float
    Uints terms;
    uint patchCount;
    float surfelSize;
    float scale;
    uint lamp;
    uint count; // of texels
};

struct LampTermsSumArguments
{
    LampTerms lamps;
    Uvec2s irradiance; // halves
};

SHARED_END

#ifndef __cplusplus

vec3 irradianceOfLamps(LampTerms lamps, uint place)
{
    vec3 sum = vec3(0.0);
    for (uint pair = 0; pair < lamps.pairs; ++pair) {
        const vec2 terms = unpackHalf2x16(lamps.terms.at[pair * lamps.count + place]);
        sum += terms.x * lamps.radiance.at[2 * pair].rgb +
               terms.y * lamps.radiance.at[2 * pair + 1].rgb;
    }
    return sum;
}

#endif

#endif
