#version 460
#extension GL_GOOGLE_include_directive : require

#include "shading/lit_sides.gpu.h"
#include "shading/lit_sides.shared.h"

ARGUMENTS(LitSidesArguments)

vec3 irradianceOf(uint list)
{
    return halves(arguments.direct.at[list]).rgb + arguments.gathered.at[list].rgb;
}

bool has(uint surfel, uint trait)
{
    return (arguments.traits.at[surfel] & trait) != 0;
}

// By its own texels, or as those around it.
vec3 albedoOf(uint surfel)
{
    if (has(surfel, kKnowsItsAlbedo))
        return albedoUnder(irradianceOf(surfel), halves(arguments.plain.at[surfel]).rgb);
    vec3 sum = vec3(0.0);
    float count = 0.0;
    const uint end = arguments.firstNeighbor.at[surfel + 1];
    for (uint i = arguments.firstNeighbor.at[surfel]; i < end; ++i) {
        const uint other = arguments.neighbor.at[i];
        if (!has(other, kKnowsItsAlbedo)) continue;
        sum += albedoUnder(irradianceOf(other), halves(arguments.plain.at[other]).rgb);
        count += 1.0;
    }
    return count > 0.0 ? sum / count : vec3(kAlbedoOfTheUnknown);
}

void main()
{
    const uint surfel = threadIndex();
    if (surfel >= arguments.count) return;
    const vec3 albedo = albedoOf(surfel);
    const vec3 least = halves(arguments.burntOut.at[surfel]).rgb;
    const vec3 white = halves(arguments.white.at[surfel]).rgb;
    vec3 clipped = vec3(0.0);
    if (!has(surfel, kShines))
        clipped = min(burntOutRadiance(albedo, irradianceOf(surfel), least, white),
                      vec3(arguments.mostBurntOut));
    vec3 back = vec3(0.0);
    const int list = arguments.backOf.at[surfel];
    if (list >= 0) back = albedo * irradianceOf(uint(list)) / kPi;
    arguments.field.at[arguments.count + surfel] = packedHalves(vec4(clipped, 0.0));
    arguments.field.at[2 * arguments.count + surfel] = packedHalves(vec4(back, 0.0));
}
