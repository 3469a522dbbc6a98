#version 450
#extension GL_GOOGLE_include_directive : require

layout(constant_id = 3) const int kView = 0;

layout(location = 0) in vec3 atRadiance;

layout(push_constant) uniform Push
{
    mat4 clipFromWorld;
    float exposure;
};

layout(location = 0) out vec4 shown;

#include "shown.glsl"

void main()
{
    shown = vec4(shownAs(kView, exposure * atRadiance), 1.0);
}
