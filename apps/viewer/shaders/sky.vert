#version 450

// What lies outside, behind all else: one triangle over the whole view.
layout(push_constant) uniform Push
{
    mat4 worldFromClip;
    vec4 radiance; // multiplies the picture; w: its turn, rad
    float exposure;
};

layout(location = 0) out vec3 along; // from the eye, of any length

void main()
{
    vec2 at = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
    vec4 near = worldFromClip * vec4(at, 0.0, 1.0);
    vec4 far = worldFromClip * vec4(at, 1.0, 1.0);
    along = far.xyz / far.w - near.xyz / near.w;
    gl_Position = vec4(at, 1.0, 1.0);
}
