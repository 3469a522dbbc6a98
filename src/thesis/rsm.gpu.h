#ifndef RELAMP_RSM_GPU_H
#define RELAMP_RSM_GPU_H

#include "gpu/compute.h"
#include "scan/texels.gpu.h"

SHARED_BEGIN

// A pixel of a reflective shadow map: what BounceLight is on the CPU.
struct RsmPixel
{
    vec3 position;
    uint page; // ~0: the view meets nothing there, or a back
    vec3 normal;
    uint pixel;
    vec3 flux; // that arrives
    uint unused;
};
SHARED_ARRAY(RsmPixels, RsmPixel)

// A thread a pixel: light after light, face after face, row after row.
struct RsmArguments
{
    Uvec4s nodes; // of scan/trace.glsl
    Uvec4s boxedTriangles;
    SurfaceTriangles triangles;
    SurfaceMeshes meshes;
    Vec4s views; // position, then intensity, of each light
    RsmPixels pixels;
    uint size; // of a face, pixels
    uint count;
};

// Gives what leaves the pixels whose surface is on one page the colour of it.
struct RsmColorArguments
{
    RsmPixels pixels;
    Uints flattened; // of that page
    Vec4s leaving;   // flux
    uint page;
    uint count;
};

SHARED_END

#endif
