// Rays in shaders: the first triangle that one meets, by the tree of scan/ray_tree.h.
#ifndef RELAMP_TRACE_GLSL
#define RELAMP_TRACE_GLSL

#include "gpu/compute.h"

const uint kNothing = ~0u;
const int kMostDepth = 48; // as in scan/ray_tree.h

struct Met
{
    uint facet; // kNothing where the ray leaves the room
    float distance;
    vec2 weights; // of the triangle's second and third corner
    bool front;   // the side that the triangle faces
};

// Where the ray enters a box; beyond `farthest` where it does not. A little is added to where it
// leaves, for the products are rounded.
float entersBox(vec3 low, vec3 high, vec3 origin, vec3 perDirection, float farthest)
{
    const vec3 a = (low - origin) * perDirection;
    const vec3 b = (high - origin) * perDirection;
    const vec3 enter = min(a, b);
    const vec3 leave = max(a, b);
    const float first = max(max(enter.x, enter.y), max(enter.z, 0.0));
    const float last = min(min(leave.x, leave.y), min(leave.z, farthest)) * 1.000001;
    return first <= last ? first : 3.0e38;
}

// Moeller & Trumbore 1997. The edges belong to both sides, so that no ray slips through.
void meetTriangle(Uvec4s triangles, uint at, vec3 origin, vec3 direction, inout Met met)
{
    const float kEdge = 1e-6;
    const uvec4 first = triangles.at[3 * at];
    const vec3 alongU = uintBitsToFloat(triangles.at[3 * at + 1].xyz);
    const vec3 alongV = uintBitsToFloat(triangles.at[3 * at + 2].xyz);
    const vec3 p = cross(direction, alongV);
    const float volume = dot(alongU, p);
    if (volume == 0.0) return;
    const vec3 way = origin - uintBitsToFloat(first.xyz);
    const float u = dot(way, p) / volume;
    const vec3 q = cross(way, alongU);
    const float v = dot(direction, q) / volume;
    const float distance = dot(alongV, q) / volume;
    if (u < -kEdge || v < -kEdge || u + v > 1.0 + kEdge) return;
    if (!(distance >= 0.0 && distance < met.distance)) return;
    met = Met(first.w, distance, vec2(u, v), volume > 0.0);
}

// `direction` is of unit length.
Met trace(Uvec4s nodes, Uvec4s triangles, vec3 origin, vec3 direction)
{
    Met met = Met(kNothing, 3.0e37, vec2(0.0), false);
    const vec3 tiny = vec3(1e-20);
    const vec3 perDirection =
        1.0 / mix(direction, tiny, lessThan(abs(direction), tiny)); // no 0 * infinity
    uint waiting[kMostDepth];
    float enteredAt[kMostDepth];
    int depth = 0;
    uint node = 0;
    while (true) {
        float enter[2];
        uint next[2];
        for (uint c = 0; c < 2; ++c) {
            const uvec4 low = nodes.at[4 * node + 2 * c];
            const uvec4 high = nodes.at[4 * node + 2 * c + 1];
            enter[c] = entersBox(uintBitsToFloat(low.xyz), uintBitsToFloat(high.xyz), origin,
                                 perDirection, met.distance);
            next[c] = low.w;
            if (high.w == 0 || enter[c] > met.distance) continue;
            for (uint i = 0; i < high.w; ++i)
                meetTriangle(triangles, low.w + i, origin, direction, met);
            enter[c] = 3.0e38;
        }
        // The nearer child first, the other waits.
        const uint near = enter[0] <= enter[1] ? 0 : 1;
        if (enter[1 - near] <= met.distance && depth < kMostDepth) {
            waiting[depth] = next[1 - near];
            enteredAt[depth++] = enter[1 - near];
        }
        if (enter[near] <= met.distance) {
            node = next[near];
            continue;
        }
        while (depth > 0 && enteredAt[depth - 1] > met.distance) --depth;
        if (depth == 0) return met;
        node = waiting[--depth];
    }
}

#endif
