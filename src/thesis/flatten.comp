#version 460
#extension GL_GOOGLE_include_directive : require

#include "scan/texels.gpu.h"
#include "thesis/flatten.gpu.h"
#include "thesis/flatten.shared.h"

ARGUMENTS(FlattenArguments)

void main()
{
    const uint i = threadIndex();
    if (i >= arguments.count) return;
    const vec3 place = positionOf(arguments.site.at[i]);
    const vec3 own = filteredAs(halves(arguments.radiance.at[i]).rgb);
    const uint surfel = arguments.surfel.at[i];
    const vec3 normal = arguments.normal.at[surfel].xyz;
    vec4 sum = vec4(0.0);
    const uint end = arguments.firstNeighbor.at[surfel + 1];
    for (uint n = arguments.firstNeighbor.at[surfel]; n < end; ++n) {
        const uint other = arguments.neighbor.at[n];
        const float facing = dot(normal, arguments.normal.at[other].xyz);
        const vec3 way = arguments.position.at[other].xyz - place;
        for (uint bin = 0; bin < kFlattenBins; ++bin) {
            const vec4 cell = arguments.cells.at[kFlattenBins * other + bin];
            if (cell.w == 0.0) break;
            sum += cell.w * facing * facing *
                   bilateralWeight(way, cell.rgb - own, arguments.perReachSquared,
                                   arguments.perRangeSquared) *
                   vec4(cell.rgb, 1.0);
        }
    }
    const vec3 filtered = sum.w > 1e-12 ? sum.rgb / sum.w : own; // nothing near has its colour
    arguments.flattened.at[arguments.pixel.at[i]] = packUnorm4x8(vec4(filtered, 1.0));
}
