#version 460
#extension GL_GOOGLE_include_directive : require

#include "base/radiometry.shared.h"
#include "relight/radiosity.gpu.h"
#include "relight/radiosity.shared.h"

ARGUMENTS(RadiosityArguments)

void main()
{
    const uint cluster = threadIndex();
    vec3 sent = vec3(0.0); // by the sky: once, and nothing after
    if (cluster < arguments.count) {
        const vec3 arriving = arguments.arriving.at[cluster].rgb;
        sent = sentOn(arguments.albedo.at[cluster].rgb, arriving);
        arguments.irradiance.at[cluster] += vec4(arguments.weight * arriving, 0.0);
    }
    if (cluster < arguments.sending) arguments.sent.at[cluster] = packedHalves(vec4(sent, 0.0));
    addUp(arguments.sums, luminance(sent), arguments.count);
}
