#include "scan/finish_mesh.h"

#include "base/fail.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kCosOfCrease = 0.7071f;
constexpr uint32_t kMostFacesToSmooth = 64; // a fan with more is no surface; keeps the cost linear
constexpr float kLargestCoordinate = 1e6f;  // metres; beyond, floats cannot hold a room's detail

bool isUsable(const glm::vec3& p)
{
    const auto inRange = [](float v) { return std::abs(v) < kLargestCoordinate; }; // false for NaN
    return inRange(p.x) && inRange(p.y) && inRange(p.z);
}

glm::vec3 areaVector(const Mesh& mesh, const glm::uvec3& triangle)
{
    const glm::vec3& a = mesh.positions[triangle.x];
    return 0.5f * glm::cross(mesh.positions[triangle.y] - a, mesh.positions[triangle.z] - a);
}

/// Keeps the triangles for which `keep` holds; returns how many went.
template<class Keep>
size_t keepTriangles(Mesh& mesh, const Keep& keep)
{
    const size_t before = mesh.triangles.size();
    std::erase_if(mesh.triangles, [&](const glm::uvec3& t) { return !keep(t); });
    return before - mesh.triangles.size();
}

void checkCounts(const Mesh& mesh, const std::string& what)
{
    const size_t count = mesh.positions.size();
    if (!mesh.uvs.empty() && mesh.uvs.size() != count)
        malformed(what, "has not one texture coordinate a vertex");
    if (!mesh.colors.empty() && mesh.colors.size() != count)
        malformed(what, "has not one colour a vertex");
    for (const glm::uvec3& t : mesh.triangles)
        if (const uint32_t last = std::max({t.x, t.y, t.z}); last >= count)
            malformed(
                what,
                fmt::format(
                    "refers to vertex {}, and it has {}; the file is damaged, export it again",
                    last, count));
}

void dropUnusable(Mesh& mesh, std::vector<std::string>& warnings)
{
    const size_t count = mesh.positions.size();
    std::vector<uint8_t> usable(count);
    for (size_t i = 0; i < count; ++i)
        usable[i] =
            isUsable(mesh.positions[i]) &&
            (mesh.uvs.empty() || (std::isfinite(mesh.uvs[i].x) && std::isfinite(mesh.uvs[i].y)));
    const size_t broken = keepTriangles(
        mesh, [&](const glm::uvec3& t) { return usable[t.x] && usable[t.y] && usable[t.z]; });
    const size_t flat = keepTriangles(mesh, [&](const glm::uvec3& t) {
        const glm::vec3 area = areaVector(mesh, t);
        return glm::dot(area, area) > 1e-24f; // (1e-6 mm^2)^2: nothing to see, no normal to trust
    });
    // Nothing refers to them any more, but no NaN may be found by accident.
    for (size_t i = 0; i < count; ++i) {
        if (usable[i]) continue;
        mesh.positions[i] = glm::vec3(0.0f);
        if (!mesh.uvs.empty()) mesh.uvs[i] = glm::vec2(0.0f);
    }
    if (broken > 0)
        warnings.push_back(
            fmt::format("mesh \"{}\": {} triangles have a vertex that is not a finite "
                        "number or lies beyond 1000 km, and were left out",
                        mesh.name, broken));
    if (flat > 0)
        warnings.push_back(
            fmt::format("mesh \"{}\": {} triangles without area were left out", mesh.name, flat));
}

void dropUnusedVertices(Mesh& mesh, std::vector<glm::vec3>& normals)
{
    constexpr uint32_t kUnused = ~0u;
    std::vector<uint32_t> newIndex(mesh.positions.size(), kUnused);
    for (const glm::uvec3& t : mesh.triangles)
        for (int c = 0; c < 3; ++c) newIndex[t[c]] = 0;
    uint32_t used = 0;
    for (uint32_t& index : newIndex)
        if (index != kUnused) index = used++;
    if (used == newIndex.size()) return;
    const auto keepUsed = [&](auto& values) {
        for (size_t i = 0; i < values.size(); ++i)
            if (newIndex[i] != kUnused) values[newIndex[i]] = values[i];
        if (!values.empty()) values.resize(used);
    };
    keepUsed(mesh.positions);
    keepUsed(mesh.uvs);
    keepUsed(mesh.colors);
    keepUsed(normals);
    for (glm::uvec3& t : mesh.triangles) t = {newIndex[t.x], newIndex[t.y], newIndex[t.z]};
}

/// For every vertex, the lowest index of those at the same place.
std::vector<uint32_t> weld(const std::vector<glm::vec3>& positions)
{
    std::vector<uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](uint32_t i) {
        const glm::vec3& p = positions[i];
        return std::tuple(p.x, p.y, p.z);
    };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        return std::tuple(key(a), a) < std::tuple(key(b), b);
    });
    std::vector<uint32_t> first(positions.size());
    for (size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
        first[order[i]] = same ? first[order[i - 1]] : order[i];
    }
    return first;
}

void smoothNormals(Mesh& mesh)
{
    const std::vector<uint32_t> vertexOf = weld(mesh.positions);
    std::vector<uint32_t> begin(mesh.positions.size() + 1, 0); // of the faces around each vertex
    for (const glm::uvec3& t : mesh.triangles)
        for (int c = 0; c < 3; ++c) ++begin[vertexOf[t[c]] + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<uint32_t> faces(3 * mesh.triangles.size());
    std::vector<uint32_t> next(begin.begin(), begin.end() - 1);
    for (uint32_t i = 0; i < mesh.triangles.size(); ++i)
        for (int c = 0; c < 3; ++c) faces[next[vertexOf[mesh.triangles[i][c]]]++] = i;

    std::vector<glm::vec3> areas(mesh.triangles.size());
    std::vector<glm::vec3> flat(mesh.triangles.size());
    for (size_t i = 0; i < areas.size(); ++i) {
        areas[i] = areaVector(mesh, mesh.triangles[i]);
        flat[i] = glm::normalize(areas[i]);
    }
    mesh.normals.resize(3 * mesh.triangles.size());
    forEachChunk(mesh.triangles.size(), 4096, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i)
            for (int c = 0; c < 3; ++c) {
                const uint32_t vertex = vertexOf[mesh.triangles[i][c]];
                const bool isFan = begin[vertex + 1] - begin[vertex] > kMostFacesToSmooth;
                glm::vec3 sum = areas[i];
                for (uint32_t f = begin[vertex]; f < begin[vertex + 1] && !isFan; ++f)
                    if (faces[f] != i && glm::dot(flat[faces[f]], flat[i]) > kCosOfCrease)
                        sum += areas[faces[f]];
                mesh.normals[3 * i + static_cast<size_t>(c)] = glm::normalize(sum);
            }
    });
}

void takeNormals(Mesh& mesh, const std::vector<glm::vec3>& vertexNormals)
{
    mesh.normals.resize(3 * mesh.triangles.size());
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::vec3 flat = glm::normalize(areaVector(mesh, mesh.triangles[i]));
        for (int c = 0; c < 3; ++c) {
            const glm::vec3 n = vertexNormals[mesh.triangles[i][c]];
            const float length = glm::length(n);
            // Zero, NaN, or on the far side of the surface it belongs to: the face knows better.
            const bool good = length > 1e-6f && glm::dot(n, flat) > 0.05f * length;
            mesh.normals[3 * i + static_cast<size_t>(c)] = good ? n / length : flat;
        }
    }
}

} // namespace

void finishMesh(Mesh& mesh, std::vector<glm::vec3> vertexNormals, const std::string& file,
                std::vector<std::string>& warnings)
{
    checkCounts(mesh, fmt::format("{}: mesh \"{}\"", file, mesh.name));
    dropUnusable(mesh, warnings);
    if (vertexNormals.size() != mesh.positions.size()) vertexNormals.clear();
    if (mesh.page >= 0) dropUnusedVertices(mesh, vertexNormals);
    vertexNormals.empty() ? smoothNormals(mesh) : takeNormals(mesh, vertexNormals);
}

} // namespace relamp
