#version 450
#extension GL_GOOGLE_include_directive : require

layout(constant_id = 3) const int kView = 0;

layout(location = 0) in vec3 along;

layout(push_constant) uniform Push
{
    mat4 worldFromClip;
    vec4 radiance; // multiplies the picture; w: its turn, rad
    float exposure;
};

layout(set = 0, binding = 0) uniform sampler2D layers[7]; // the first: the picture, or white

layout(location = 0) out vec4 shown;

#include "relight/sky_bins.shared.h"
#include "shown.glsl"

void main()
{
    // No smaller level: where the picture meets itself again, neighbours lie far apart in it.
    vec3 picture = textureLod(layers[0], placeInSky(normalize(along), radiance.w), 0.0).rgb;
    shown = vec4(shownAs(kView, exposure * radiance.rgb * picture), 1.0);
}
