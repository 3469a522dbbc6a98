#include "scan/finish_mesh.h"

#include "base/fail.h"
#include "base/parallel.h"
#include "scan/check_numbers.h"
#include "scan/even_normals.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kCosOfCrease = 0.7071f;
constexpr float kNoise = 0.01f; // rad; no model leans by as much, and any scan by more

glm::vec3 areaVector(const Mesh& mesh, const glm::uvec3& triangle)
{
    const glm::vec3& a = mesh.positions[triangle.x];
    return 0.5f * glm::cross(mesh.positions[triangle.y] - a, mesh.positions[triangle.z] - a);
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

void dropFlat(Mesh& mesh, std::vector<std::string>& warnings)
{
    const size_t flat = std::erase_if(mesh.triangles, [&](const glm::uvec3& t) {
        const glm::vec3 area = areaVector(mesh, t);
        return !(glm::dot(area, area) > 1e-24f); // (1e-6 mm^2)^2: no normal to trust
    });
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

struct Faces
{
    std::vector<glm::vec3> normals; // unit
    std::vector<float> area;        // m^2
};

Faces facesOf(const Mesh& mesh)
{
    Faces faces;
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::vec3 area = areaVector(mesh, triangle);
        faces.area.push_back(glm::length(area));
        faces.normals.push_back(area / faces.area.back());
    }
    return faces;
}

/// Normals of corners: of the faces around, except over edges sharper than a crease.
std::vector<glm::vec3> smoothed(std::span<const glm::vec3> normals, std::span<const float> area,
                                const VertexFans& fans)
{
    std::vector<glm::vec3> corners(3 * normals.size());
    forEachChunk(normals.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            for (int c = 0; c < 3; ++c) {
                glm::vec3 sum = area[i] * normals[i];
                for (const uint32_t other : fans.around(i, c))
                    if (other != i && glm::dot(normals[other], normals[i]) > kCosOfCrease)
                        sum += area[other] * normals[other];
                corners[3 * i + static_cast<size_t>(c)] = glm::normalize(sum);
            }
    });
    return corners;
}

/// Of the file, where they are on the near side of the surface; zero is not, and there the face
/// knows better.
void takeNormals(Mesh& mesh, std::span<const glm::vec3> vertexNormals,
                 std::span<const glm::vec3> faces)
{
    mesh.normals.resize(3 * mesh.triangles.size());
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const glm::vec3 n = vertexNormals[mesh.triangles[i][c]];
            const float length = glm::length(n);
            const bool good = length > 1e-6f && glm::dot(n, faces[i]) > 0.05f * length;
            mesh.normals[3 * i + static_cast<size_t>(c)] = good ? n / length : faces[i];
        }
}

/// Whether half of a surface leans by more than that from what lies around it.
bool isNoisy(const Faces& faces, std::span<const glm::vec3> even)
{
    double noisy = 0.0;
    double all = 0.0;
    for (size_t i = 0; i < even.size(); ++i) {
        const auto area = static_cast<double>(faces.area[i]);
        if (glm::distance(even[i], faces.normals[i]) > kNoise) noisy += area;
        all += area;
    }
    return noisy > 0.5 * all;
}

/// Means of the triangles' corners.
std::vector<glm::vec3> facingsOf(std::span<const glm::vec3> corners)
{
    std::vector<glm::vec3> facings;
    facings.reserve(corners.size() / 3);
    for (size_t c = 0; c < corners.size(); c += 3)
        facings.push_back(glm::normalize(corners[c] + corners[c + 1] + corners[c + 2]));
    return facings;
}

/// Normals of corners. A reconstruction's are of its faces evened out, for the file's have the same
/// noise.
void findNormals(Mesh& mesh, std::span<const glm::vec3> vertexNormals)
{
    const VertexFans fans(mesh);
    const Faces faces = facesOf(mesh);
    const std::vector<glm::vec3> even = evenNormals(faces.normals, faces.area, fans);
    if (vertexNormals.empty())
        mesh.normals = smoothed(faces.normals, faces.area, fans);
    else
        takeNormals(mesh, vertexNormals, faces.normals);
    if (!isNoisy(faces, even)) return;
    mesh.facings = facingsOf(mesh.normals);
    mesh.normals = smoothed(even, faces.area, fans);
}

} // namespace

void finishMesh(Mesh& mesh, std::vector<glm::vec3> vertexNormals, const std::string& file,
                std::vector<std::string>& warnings)
{
    checkCounts(mesh, fmt::format("{}: mesh \"{}\"", file, mesh.name));
    if (vertexNormals.size() != mesh.positions.size()) vertexNormals.clear();
    checkNumbers(mesh, vertexNormals, file);
    dropFlat(mesh, warnings);
    if (mesh.page >= 0) dropUnusedVertices(mesh, vertexNormals);
    findNormals(mesh, vertexNormals);
}

} // namespace relamp
