#version 460
#extension GL_GOOGLE_include_directive : require

#include "base/radiometry.shared.h"
#include "shading/gather.gpu.h"
#include "shading/gather.shared.h"

ARGUMENTS(GatherArguments)

void main()
{
    const uint list = threadIndex();
    if (list >= arguments.count) return;
    const uint begin = arguments.first.at[list];
    const uint end = arguments.first.at[list + 1];
    vec3 sum = vec3(0.0);
    float squares = 0.0;
    float missed = 0.0;
    float rays = 0.0;
    for (uint i = begin + min(list % arguments.step, end - begin - 1); i < end;
         i += arguments.step) {
        rays += 1.0;
        const uint target = arguments.target.at[i];
        if (target >= arguments.outside) missed += 1.0;
        const vec3 radiance = halves(arguments.radiance.at[target]).rgb;
        const float brightness = luminance(radiance);
        sum += radiance;
        squares += brightness * brightness;
    }
    arguments.irradiance.at[list] =
        vec4(irradiancePerRay(rays) * sum, noiseOfRays(luminance(sum), squares, rays));
    arguments.missed.at[list] = irradiancePerRay(rays) * missed;
}
