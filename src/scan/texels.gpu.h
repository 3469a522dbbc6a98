#ifndef RELAMP_TEXELS_GPU_H
#define RELAMP_TEXELS_GPU_H

#include "gpu/compute.h"
#include "scan/site.shared.h"

SHARED_BEGIN

// Where a texel lies: position as floats, and the normal, octahedral in two 16-bit numbers.
#ifndef __cplusplus
vec3 positionOf(uvec4 site)
{
    return uintBitsToFloat(site.xyz);
}
vec3 normalOf(uvec4 site)
{
    return fromOctahedral(unpackSnorm2x16(site.w));
}
#endif

// What a ray needs to know of the triangle that it met.
struct SurfaceTriangle
{
    vec2 corners[3]; // on the page, in pixels; on a page of vertices, x is a pixel's number
    uint normals[3]; // octahedral
    uint mesh;
};
SHARED_ARRAY(SurfaceTriangles, SurfaceTriangle)

struct SurfaceMesh
{
    uint page;
    uint width; // of the page
    uint height;
    uint ofVertices; // not 0: the page is
    uint repeatsU;   // not 0: what lies beyond an edge of the page comes in at the other
    uint repeatsV;
};
SHARED_ARRAY(SurfaceMeshes, SurfaceMesh)

SHARED_END

#endif
