#version 450
#extension GL_GOOGLE_include_directive : require

// One layer of the room's surface, as the view shows it.
layout(constant_id = 0) const bool kOfVertices = false;
layout(constant_id = 2) const int kLayer = 0;
layout(constant_id = 3) const int kView = 0; // standard, AgX, ACES; 3: light itself, for EXR
layout(constant_id = 4) const bool kLines = false; // of the triangles' edges

layout(location = 0) in vec2 atUv;
layout(location = 1) in vec3 atColour;
layout(location = 2) in vec3 atShading;
layout(location = 3) in vec3 atEmission;
layout(location = 4) in vec3 ofVertex;
layout(location = 5) in vec3 secondOfVertex;

layout(push_constant) uniform Push
{
    mat4 clipFromWorld;
    float exposure;
};

layout(set = 0, binding = 0) uniform sampler2D layers[7];

layout(location = 0) out vec4 shown;

#include "image/burnt_out.shared.h"
#include "layers.glsl"
#include "shown.glsl"

vec3 valueOf(int layer)
{
    return texture(layers[layer], atUv).rgb;
}

// What the layer holds here.
vec3 layerHere()
{
    vec3 first = kOfVertices ? ofVertex : valueOf(kFirstTexture);
    if (kLayer == kScan) return kOfVertices ? first : first * atColour;
    if (kLayer == kConfidence) return first.rrr;
    if (kLayer == kShading) return first + (kOfVertices ? secondOfVertex : valueOf(kIndirectTexture));
    if (kLayer == kGlance) {
        vec3 lit = first * atShading;
        if (brightestChannel(atEmission) <= 0.0) return lit;
        vec3 scan = kOfVertices ? secondOfVertex : valueOf(kScanTexture) * atColour;
        return isBurntOut(scan, true) ? atEmission : lit;
    }
    return first;
}

void main()
{
    if (kLines) {
        shown = vec4(0.05, 0.45, 0.85, 0.4);
        return;
    }
    bool isLight = kLayer != kAlbedo && kLayer != kConfidence;
    shown = isLight ? vec4(shownAs(kView, exposure * layerHere()), 1.0)
                    : vec4(kLayer == kConfidence && kView != 3 ? layerHere()
                                                               : shownAs(kView == 3 ? 3 : 0, layerHere()),
                           1.0);
}
