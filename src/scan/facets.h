#pragma once

#include "relamp/scan.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace relamp
{

/// A triangle as an affine map from its page into the room, or a coloured vertex as a constant one.
///
/// Pixel (column, row) of the page is the world point
///     position + (column - pixel.x) * positionX + (row - pixel.y) * positionY
/// and its normal, not yet of unit length, the same with normal, normalX, normalY. Three rows of
/// eight numbers, so that place and normal are one vector: that at `pixel`, and its two gradients.
struct alignas(32) Facet
{
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};
    glm::vec2 pixel{0.0f};
    glm::vec3 positionX{0.0f}; // metres a column
    glm::vec3 normalX{0.0f};
    float texelArea = 0.0f; // m^2 of one pixel; 0 for a triangle without extent on its page
    float unused = 0.0f;
    glm::vec3 positionY{0.0f}; // metres a row
    glm::vec3 normalY{0.0f};
    glm::vec2 unusedToo{0.0f};
};

/// Place and normal of `pixel` (column, row), not yet of unit length, six numbers, and two more
/// that are none of these.
inline void placeOn(const Facet& facet, glm::vec2 pixel, float* place)
{
    constexpr size_t kRow = 8;
    static_assert(sizeof(Facet) == 3 * kRow * sizeof(float));
    static_assert(offsetof(Facet, normal) == 3 * sizeof(float));
    static_assert(offsetof(Facet, positionX) == kRow * sizeof(float));
    static_assert(offsetof(Facet, normalX) == (kRow + 3) * sizeof(float));
    static_assert(offsetof(Facet, positionY) == 2 * kRow * sizeof(float));
    static_assert(offsetof(Facet, normalY) == (2 * kRow + 3) * sizeof(float));
    const float* const rows = &facet.position.x;
    const glm::vec2 way = pixel - facet.pixel;
    for (size_t k = 0; k < kRow; ++k)
        place[k] = rows[k] + way.x * rows[kRow + k] + way.y * rows[2 * kRow + k];
}

/// A place on a surface.
struct TexelSite
{
    glm::vec3 position; // world, m
    glm::vec3 normal;   // unit
};

/// Where `pixel` (column, row) of a facet's page lies. A little beyond a triangle, where the
/// normals of its corners may cancel out, it faces as its first corner.
TexelSite siteOn(const Facet& facet, glm::vec2 pixel);

/// All facets of a scan: its triangles, mesh after mesh, then the vertices of its page of vertices.
struct Facets
{
    std::vector<Facet> facets;
    std::vector<uint32_t> meshOf;      // of facets: index into Scan::meshes
    std::vector<uint32_t> firstOfMesh; // of the triangles; one more entry than meshes
    size_t triangles = 0; // facets from here on are vertices, in the order of their pixels
};

Facets buildFacets(const Scan& scan);

/// Corners of a triangle on its page in pixels: (0, 0) is the centre of the first. The triangle is
/// moved by whole pages so that its centroid lies on the page, as wrapping shows it.
struct PixelTriangle
{
    glm::dvec2 corner[3];
};
PixelTriangle pixelTriangle(const Scan& scan, const Mesh& mesh, const glm::uvec3& triangle);

/// What a vertex colour adds to a texture: linear RGB at the three corners, as Facet's affine map.
struct Tint
{
    glm::vec3 color{1.0f};
    glm::vec3 colorX{0.0f};
    glm::vec3 colorY{0.0f};
};
Tint tintOf(const Scan& scan, const Facets& facets, uint32_t facet);

} // namespace relamp
