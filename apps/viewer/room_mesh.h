#pragma once

#include "relamp/scan.h"

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

/// A vertex as it is drawn.
struct RoomVertex
{
    glm::vec3 position{0.0f}; // world, m
    glm::vec2 uv{0.0f};       // of a page of vertices, the middle of its pixel
    glm::vec3 colour{1.0f};   // linear; multiplies the page
};

/// Triangles of one page, drawn at once.
struct RoomSurface
{
    uint32_t firstIndex = 0;
    uint32_t indices = 0;
    uint32_t firstEdge = 0; // in RoomMesh::edges
    uint32_t edges = 0;     // two each
    int page = 0;
    relamp::Wrap wrapU = relamp::Wrap::repeat;
    relamp::Wrap wrapV = relamp::Wrap::repeat;
    bool ofVertices = false;
};

/// A scan's surface, cut so finely that light at its vertices is light on the surface.
struct RoomMesh
{
    std::vector<RoomVertex> vertices;
    std::vector<glm::vec3> normals; // of vertices, unit
    std::vector<uint32_t> indices;
    std::vector<uint32_t> edges; // of the scan's own triangles, two vertices each
    std::vector<RoomSurface> surfaces;
    relamp::Bounds bounds;
    float longestEdge = 0.0f; // m, that was aimed at
};

/// Cuts edges until none is longer than `longestEdge`, in m; 0 chooses 3 cm or, in a large scan, so
/// much that there are about 150,000 triangles. Meshes coloured by their vertices stay as they are.
///
/// Whether an edge is cut depends on its ends alone, so neighbours agree and no gap opens. A vertex
/// on a crease becomes one a side, as the light differs there.
RoomMesh roomMesh(const relamp::Scan& scan, float longestEdge = 0.0f);
