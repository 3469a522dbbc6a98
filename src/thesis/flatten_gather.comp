#version 460
#extension GL_GOOGLE_include_directive : require

#include "thesis/flatten.gpu.h"
#include "thesis/flatten.shared.h"

ARGUMENTS(FlattenGatherArguments)

void main()
{
    const uint run = threadIndex();
    if (run >= arguments.count) return;
    vec4 sums[kFlattenBins];
    for (int bin = 0; bin < kFlattenBins; ++bin) sums[bin] = vec4(0.0);
    const uvec2 here = arguments.runs.at[run]; // surfel, first texel
    const uvec2 next = arguments.runs.at[run + 1];
    for (uint i = here.y; i < next.y; ++i) {
        const vec4 texel = halves(arguments.radiance.at[i]);
        const vec3 root = filteredAs(texel.rgb);
        const float width = 1e-3 * texel.w;
        sums[brightnessBin(root)] += width * width * vec4(root, 1.0);
    }
    const uint first = kFlattenBins * here.x;
    for (int bin = 0; bin < kFlattenBins; ++bin)
        if (sums[bin].w > 0.0) arguments.cells.at[first + bin] += sums[bin];
}
