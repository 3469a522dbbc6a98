#version 460
#extension GL_GOOGLE_include_directive : require

#include "thesis/flatten.gpu.h"
#include "thesis/flatten.shared.h"

ARGUMENTS(FlattenFinishArguments)

void main()
{
    const uint surfel = threadIndex();
    if (surfel >= arguments.count) return;
    const uint first = kFlattenBins * surfel;
    uint next = first;
    for (int bin = 0; bin < kFlattenBins; ++bin) {
        const vec4 sum = arguments.cells.at[first + bin];
        if (sum.w > 0.0) arguments.cells.at[next++] = vec4(sum.rgb / sum.w, sum.w);
    }
    while (next < first + kFlattenBins) arguments.cells.at[next++] = vec4(0.0);
}
