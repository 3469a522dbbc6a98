#version 460
#extension GL_GOOGLE_include_directive : require

#include "image/padding.gpu.h"

ARGUMENTS(PaddingArguments)

void main()
{
    const uint i = threadIndex();
    if (i >= arguments.count) return;
    const uvec2 at = 2 * uvec2(i % arguments.coarseWidth, i / arguments.coarseWidth);
    vec4 sum = vec4(0.0);
    for (uint k = 0; k < 4; ++k) {
        const uvec2 from = at + uvec2(k % 2, k / 2);
        if (from.x >= arguments.fineWidth || from.y >= arguments.fineHeight) continue;
        const vec4 pixel = halves(arguments.fine.at[from.y * arguments.fineWidth + from.x]);
        if (pixel.w > 0.0) sum += pixel;
    }
    arguments.coarse.at[i] = packedHalves(sum.w > 0.0 ? sum / sum.w : vec4(0.0));
}
