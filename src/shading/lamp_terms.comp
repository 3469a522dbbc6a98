#version 460
#extension GL_GOOGLE_include_directive : require

#include "scan/texels.gpu.h"
#include "shading/lamp_patches.shared.h"
#include "shading/lamp_terms.gpu.h"
#include "shading/mesh_noise.shared.h"
#include "shading/visibility.shared.h"

ARGUMENTS(LampTermsArguments)

// Share of the lamp that a place of a surfel sees, by the probes around it.
float shareSeen(uint surfel, vec3 place)
{
    const uint seen = byteAt(arguments.seen, surfel);
    if (seen != kSeesSome) return seen == kSeesAll ? 1.0 : 0.0;
    const vec3 middle = arguments.position.at[surfel].xyz;
    const uvec2 own = arguments.probesOf.at[surfel];
    const float reach = uintBitsToFloat(own.y);
    const float far = arguments.surfelSize + reach;
    float sum = 0.0;
    float weights = 0.0;
    uint taken = 0;
    const uint end = arguments.firstNeighbor.at[surfel + 1];
    for (uint i = arguments.firstNeighbor.at[surfel]; i < end; ++i) {
        const uint other = arguments.neighbor.at[i];
        if (byteAt(arguments.seen, other) != kSeesSome) continue;
        const uvec2 first = arguments.probesOf.at[other];
        const uvec2 last = arguments.probesOf.at[other + 1];
        for (uint p = first.x; p < last.x && taken < kMostProbes; ++p) {
            const uint share = byteAt(arguments.shares, p);
            if (share == kShareUnknown) continue;
            const vec3 probe = arguments.probes.at[p].xyz;
            const vec3 off = probe - middle;
            if (other != surfel && dot(off, off) > far * far) continue;
            const float w = probeWeight(probe - place, 1.0 / (reach * reach));
            sum += w * float(share) / float(kShareOfAll);
            weights += w;
            ++taken;
        }
    }
    return taken > 0 ? sum / weights : 0.0;
}

struct Patch
{
    vec3 middle;
    float farSquared;
    vec3 facing;
    float perRamp;
    float area;
    float spread;
    uint after;
    uint depth;
};

Patch patchOf(uint i)
{
    const uvec4 a = arguments.patches.at[3 * i];
    const uvec4 b = arguments.patches.at[3 * i + 1];
    const uvec4 c = arguments.patches.at[3 * i + 2];
    return Patch(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz),
                 uintBitsToFloat(b.w), uintBitsToFloat(c.x), uintBitsToFloat(c.y), c.z, c.w);
}

// Geometry::scanned: these are the lamps of a scan as it was captured.
float openIrradiance(vec3 place, vec3 normal)
{
    float sum = 0.0;
    float asked[kMostDepth + 1]; // of the patches at a depth
    asked[0] = 1.0;
    for (uint i = 0; i < arguments.patchCount;) {
        const Patch lamp = patchOf(i);
        const float own = asked[lamp.depth];
        if (own <= 0.0) {
            i = lamp.after;
            continue;
        }
        const vec3 way = lamp.middle - place;
        const float share = shareOfParts(dot(way, way), lamp.farSquared, lamp.perRamp);
        const float wide = wideFormFactor(way, normal, lamp.facing, lamp.spread);
        const float near =
            lamp.after > i + 1 ? 0.0 : nearFormFactor(way, normal, lamp.facing, lamp.area);
        const float believed = shareBeyondMeshNoise(way, normal, lamp.facing);
        sum += own * lamp.area * believed * (wide + share * (near - wide));
        asked[lamp.depth + 1] = own * share;
        ++i;
    }
    return sum;
}

void main()
{
    const uint i = threadIndex();
    if (i >= arguments.count) return;
    const uvec4 site = arguments.site.at[i];
    const vec3 place = positionOf(site);
    const float share = shareSeen(arguments.surfel.at[i], place);
    const float term =
        share > 0.0 ? arguments.scale * share * openIrradiance(place, normalOf(site)) : 0.0;
    const uint bits = packHalf2x16(vec2(min(term, 65504.0), 0.0));
    const uint at = arguments.lamp / 2 * arguments.count + i;
    arguments.terms.at[at] = arguments.lamp % 2 == 0 ? bits : arguments.terms.at[at] | bits << 16;
}
