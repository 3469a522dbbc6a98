#version 460
#extension GL_GOOGLE_include_directive : require

#include "image/padding.gpu.h"

ARGUMENTS(PaddingArguments)

void main()
{
    const uint i = threadIndex();
    if (i >= arguments.count || halves(arguments.fine.at[i]).w > 0.0) return;
    const uvec2 at = uvec2(i % arguments.fineWidth, i / arguments.fineWidth) / 2;
    const vec4 pixel = halves(arguments.coarse.at[at.y * arguments.coarseWidth + at.x]);
    arguments.fine.at[i] = packedHalves(vec4(pixel.rgb, 0.0));
}
