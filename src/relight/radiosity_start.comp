#version 460
#extension GL_GOOGLE_include_directive : require

#include "base/radiometry.shared.h"
#include "relight/radiosity.gpu.h"
#include "relight/radiosity.shared.h"

ARGUMENTS(RadiosityStartArguments)

// What a cluster sends of its direct light, by the weights of its members.
vec3 start(uint cluster)
{
    vec3 albedo = vec3(0.0);
    vec3 sent = vec3(0.0);
    const uint end = arguments.firstMember.at[cluster + 1];
    for (uint i = arguments.firstMember.at[cluster]; i < end; ++i) {
        const uint side = arguments.member.at[i];
        const vec4 ofSurfel = arguments.albedo.at[arguments.surfel.at[side]];
        const vec3 share = arguments.weight.at[side] * ofSurfel.rgb;
        albedo += share;
        sent += sentOn(share, arguments.direct.at[side].rgb);
    }
    arguments.ofClusters.at[cluster] = vec4(albedo, 0.0);
    arguments.irradiance.at[cluster] = vec4(0.0);
    arguments.sent.at[cluster] = packedHalves(vec4(sent, 0.0));
    return sent;
}

void main()
{
    const uint cluster = threadIndex();
    float brightness = 0.0;
    if (cluster < arguments.count) brightness = luminance(start(cluster));
    addUp(arguments.sums, brightness, arguments.count);
}
