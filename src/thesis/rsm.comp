#version 460
#extension GL_GOOGLE_include_directive : require

#include "scan/trace.glsl"
#include "scan/wrap.shared.h"
#include "thesis/rsm.gpu.h"
#include "thesis/rsm.shared.h"

ARGUMENTS(RsmArguments)

// The pixel of its page that lies nearest to where the ray met the triangle.
uint nearestPixel(SurfaceTriangle triangle, SurfaceMesh mesh, vec3 weights)
{
    if (mesh.ofVertices != 0) {
        const int corner = weights.x >= weights.y && weights.x >= weights.z ? 0
                           : weights.y >= weights.z                         ? 1
                                                                            : 2;
        return floatBitsToUint(triangle.corners[corner].x);
    }
    const vec2 at = floor(weights.x * triangle.corners[0] + weights.y * triangle.corners[1] +
                          weights.z * triangle.corners[2] + 0.5);
    const uint column = uint(wrappedPixel(at.x, float(mesh.width), mesh.repeatsU != 0));
    const uint row = uint(wrappedPixel(at.y, float(mesh.height), mesh.repeatsV != 0));
    return row * mesh.width + column;
}

vec3 normalAt(SurfaceTriangle triangle, vec3 weights)
{
    vec3 normal = vec3(0.0);
    for (int c = 0; c < 3; ++c)
        normal += weights[c] * fromOctahedral(unpackSnorm2x16(triangle.normals[c]));
    return normalize(normal);
}

void main()
{
    const uint i = threadIndex();
    if (i >= arguments.count) return;
    const uint size = arguments.size;
    const uint light = i / (6 * size * size);
    const int face = int(i / (size * size) % 6);
    const float u = (2.0 * float(i % size) + 1.0) / float(size) - 1.0;
    const float v = (2.0 * float(i / size % size) + 1.0) / float(size) - 1.0;
    const vec3 origin = arguments.views.at[2 * light].xyz;
    const vec3 direction = cubeDirection(face, u, v);

    const Met met = trace(arguments.nodes, arguments.boxedTriangles, origin, direction);
    arguments.pixels.at[i].page = ~0u;
    if (met.facet == kNothing || !met.front) return;
    const SurfaceTriangle triangle = arguments.triangles.at[met.facet];
    const SurfaceMesh mesh = arguments.meshes.at[triangle.mesh];
    const vec3 weights = vec3(1.0 - met.weights.x - met.weights.y, met.weights);
    const vec3 flux =
        arguments.views.at[2 * light + 1].rgb * cubePixelSolidAngle(u, v, float(size));
    arguments.pixels.at[i] =
        RsmPixel(origin + met.distance * direction, mesh.page, normalAt(triangle, weights),
                 nearestPixel(triangle, mesh, weights), flux, 0);
}
