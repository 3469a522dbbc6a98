#version 460
#extension GL_GOOGLE_include_directive : require

#include "base/radiometry.shared.h"
#include "scan/texels.gpu.h"
#include "shading/gathered_light.shared.h"
#include "solve/reevaluate.gpu.h"

ARGUMENTS(ReevaluateArguments)

// Between the surfels of one surface; w: share of the light that is there.
vec4 interpolated(uint surfel, vec3 place, vec3 normal)
{
    const uint begin = arguments.firstNeighbor.at[surfel];
    const uint end = min(arguments.firstNeighbor.at[surfel + 1], begin + kMostTaps);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (uint i = begin; i < end; ++i) {
        const uint tap = arguments.neighbor.at[i];
        const float w = tapWeight(arguments.position.at[tap].xyz - place, normal,
                                  arguments.normal.at[tap].xyz, arguments.perReachSquared);
        sum += w * arguments.indirect.at[tap];
        weights += w;
    }
    return sum / weights;
}

void main()
{
    const uint i = threadIndex();
    if (i >= arguments.lamps.count) return;
    const uvec4 site = arguments.site.at[i];
    const vec4 around = interpolated(arguments.surfel.at[i], positionOf(site), normalOf(site));
    const vec3 direct = irradianceOfLamps(arguments.lamps, i);
    arguments.directOut.at[i] = packedHalves(vec4(around.w * direct, 0.0));
    arguments.indirectOut.at[i] = packedHalves(vec4(around.w * around.rgb, 0.0));
}
