#version 460
#extension GL_GOOGLE_include_directive : require

#include "thesis/rsm.gpu.h"

ARGUMENTS(RsmColorArguments)

void main()
{
    const uint i = threadIndex();
    if (i >= arguments.count || arguments.pixels.at[i].page != arguments.page) return;
    const RsmPixel pixel = arguments.pixels.at[i];
    const vec3 root = unpackUnorm4x8(arguments.flattened.at[pixel.pixel]).rgb;
    arguments.leaving.at[i] = vec4(pixel.flux * root * root, 0.0);
}
