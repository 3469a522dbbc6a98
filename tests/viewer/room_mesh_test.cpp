#include "room_mesh.h"

#include <algorithm>
#include <map>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace
{

/// Two walls that meet in an edge, vertices shared along it.
relamp::Scan corner()
{
    relamp::Scan scan;
    scan.pages.emplace_back();
    scan.pages[0].image.width = scan.pages[0].image.height = 4;
    scan.pages[0].image.encoded().assign(48, 128);
    relamp::Mesh mesh;
    mesh.page = 0;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 2}, {0, 0, 2}, {0, 1, 0}, {1, 1, 0}};
    mesh.uvs.assign(6, glm::vec2(0.5f));
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}};
    mesh.normals.assign(6, {0, 1, 0});
    mesh.normals.resize(12, {0, 0, 1});
    scan.meshes.push_back(mesh);
    return scan;
}

double areaOf(const RoomMesh& mesh)
{
    double area = 0.0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto at = [&](size_t k) { return mesh.vertices[mesh.indices[i + k]].position; };
        area += 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
    }
    return area;
}

TEST(RoomMesh, HasNoEdgeThatIsTooLongAndTheSameSurface)
{
    const RoomMesh mesh = roomMesh(corner(), 0.2f);

    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        const size_t next = i % 3 == 2 ? i - 2 : i + 1;
        EXPECT_LE(glm::distance(mesh.vertices[mesh.indices[i]].position,
                                mesh.vertices[mesh.indices[next]].position),
                  0.2001f);
    }
    EXPECT_NEAR(areaOf(mesh), 3.0, 1e-4);
}

// Light differs on the two walls, so a vertex of the crease is there once for each.
TEST(RoomMesh, ACreaseHasAVertexASide)
{
    const RoomMesh mesh = roomMesh(corner(), 10.0f);

    EXPECT_EQ(mesh.vertices.size(), 8u);
    for (const glm::vec3& normal : mesh.normals)
        EXPECT_NEAR(std::max(normal.y, normal.z), 1.0f, 1e-5f);
}

// An edge inside a surface belongs to two triangles; a gap would leave a vertex on an edge of one.
TEST(RoomMesh, NeighboursAreCutAlike)
{
    const RoomMesh mesh = roomMesh(corner(), 0.3f);
    std::map<std::pair<uint32_t, uint32_t>, int> uses;
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        const uint32_t a = mesh.indices[i];
        const uint32_t b = mesh.indices[i % 3 == 2 ? i - 2 : i + 1];
        ++uses[{std::min(a, b), std::max(a, b)}];
    }
    double border = 0.0;
    for (const auto& [edge, count] : uses) {
        EXPECT_LE(count, 2);
        if (count == 1)
            border += glm::distance(mesh.vertices[edge.first].position,
                                    mesh.vertices[edge.second].position);
    }
    EXPECT_NEAR(border, 6.0 + 4.0, 1e-4); // around each wall
}

} // namespace
