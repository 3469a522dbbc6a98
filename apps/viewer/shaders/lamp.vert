#version 450

// The surface of a light that somebody put up.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 radiance;

layout(push_constant) uniform Push
{
    mat4 clipFromWorld;
    float exposure;
};

layout(location = 0) out vec3 atRadiance;

void main()
{
    atRadiance = radiance;
    gl_Position = clipFromWorld * vec4(position, 1.0);
}
