#version 450
#extension GL_GOOGLE_include_directive : require

// A vertex of the room, its own light with it.
layout(constant_id = 0) const bool kOfVertices = false; // its page is a list of vertices' colours
layout(constant_id = 1) const bool kAtlas = false;      // laid out as its texture is
layout(constant_id = 2) const int kLayer = 0;

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv; // of a page of vertices, the pixel's middle
layout(location = 2) in vec3 colour;
layout(location = 3) in vec3 shading;
layout(location = 4) in vec3 emission;

layout(push_constant) uniform Push
{
    mat4 clipFromWorld; // clipFromAtlas where kAtlas
    float exposure;     // factor on light
};

layout(set = 0, binding = 0) uniform sampler2D layers[7];

layout(location = 0) out vec2 atUv;
layout(location = 1) out vec3 atColour;
layout(location = 2) out vec3 atShading;
layout(location = 3) out vec3 atEmission;
layout(location = 4) out vec3 ofVertex;       // the layer's own value
layout(location = 5) out vec3 secondOfVertex; // and that of the one that is added to it

#include "layers.glsl"

vec3 pixelOf(int layer)
{
    return texelFetch(layers[layer], ivec2(uv * vec2(textureSize(layers[layer], 0))), 0).rgb;
}

void main()
{
    atUv = uv;
    atColour = colour;
    atShading = shading;
    atEmission = emission;
    ofVertex = vec3(0.0);
    secondOfVertex = vec3(0.0);
    if (kOfVertices) {
        ofVertex = pixelOf(kFirstTexture);
        if (kLayer == kShading) secondOfVertex = pixelOf(kIndirectTexture);
        if (kLayer == kGlance) secondOfVertex = pixelOf(kScanTexture);
    }
    gl_Position = clipFromWorld * (kAtlas ? vec4(uv, 0.0, 1.0) : vec4(position, 1.0));
}
