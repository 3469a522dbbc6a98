#ifndef RELAMP_SITE_SHARED_H
#define RELAMP_SITE_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

// Unit vectors on a square, each coordinate in [-1, 1] (Cigolle et al., "A Survey of Efficient
// Representations for Independent Unit Vectors", JCGT 2014: octahedral). Two 16-bit numbers hold a
// direction to 1e-4.
SHARED_FN vec2 octahedral(vec3 n)
{
    const vec2 p = vec2(n.x, n.y) / max(abs(n.x) + abs(n.y) + abs(n.z), 1e-20f);
    if (n.z >= 0.0f) return p;
    return vec2((1.0f - abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f),
                (1.0f - abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f));
}

SHARED_FN vec3 fromOctahedral(vec2 p)
{
    const float z = 1.0f - abs(p.x) - abs(p.y);
    const float fold = max(-z, 0.0f);
    return normalize(
        vec3(p.x + (p.x >= 0.0f ? -fold : fold), p.y + (p.y >= 0.0f ? -fold : fold), z));
}

SHARED_END

#endif
