#include "base/radiometry.shared.h"
#include "scan/even_normals.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using Surface = std::function<glm::vec3(float u, float v)>; // u, v in cells

/// A grid of `cells` x `cells` squares, two triangles each.
Mesh sheet(int cells, const Surface& surface)
{
    Mesh mesh;
    const auto vertex = [&](int x, int y) { return static_cast<uint32_t>(y * (cells + 1) + x); };
    for (int y = 0; y <= cells; ++y)
        for (int x = 0; x <= cells; ++x)
            mesh.positions.push_back(surface(static_cast<float>(x), static_cast<float>(y)));
    for (int y = 0; y < cells; ++y)
        for (int x = 0; x < cells; ++x) {
            mesh.triangles.emplace_back(vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1));
            mesh.triangles.emplace_back(vertex(x, y), vertex(x + 1, y + 1), vertex(x, y + 1));
        }
    return mesh;
}

struct Normals
{
    std::vector<glm::vec3> raw;
    std::vector<glm::vec3> even;
};

Normals normalsOf(const Mesh& mesh)
{
    Normals normals;
    std::vector<float> area;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 a = mesh.positions[t.x];
        const glm::vec3 twice = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
        area.push_back(0.5f * glm::length(twice));
        normals.raw.push_back(glm::normalize(twice));
    }
    normals.even = evenNormals(normals.raw, area, VertexFans(mesh));
    return normals;
}

float rmsFrom(std::span<const glm::vec3> normals, glm::vec3 wanted)
{
    float sum = 0.0f;
    for (const glm::vec3 normal : normals) sum += glm::dot(normal - wanted, normal - wanted);
    return std::sqrt(sum / static_cast<float>(normals.size()));
}

} // namespace

// A wall of triangles 5 cm wide that are 3 mm off.
TEST(EvenNormals, NoiseOfAWallGoes)
{
    std::mt19937 random(1);
    std::normal_distribution<float> error(0.0f, 0.003f);
    const Mesh wall =
        sheet(32, [&](float u, float v) { return glm::vec3(0.05f * u, 0.05f * v, error(random)); });
    const Normals normals = normalsOf(wall);
    const glm::vec3 ahead(0, 0, 1);
    EXPECT_GT(rmsFrom(normals.raw, ahead), 0.07f);
    EXPECT_LT(rmsFrom(normals.even, ahead), 0.25f * rmsFrom(normals.raw, ahead));
}

TEST(EvenNormals, CornerStaysSharp)
{
    const Mesh corner = sheet(16, [](float u, float v) {
        return 0.05f * glm::vec3(std::min(u, 8.0f), v, std::max(u - 8.0f, 0.0f));
    });
    const Normals normals = normalsOf(corner);
    for (size_t i = 0; i < normals.raw.size(); ++i)
        EXPECT_LT(glm::distance(normals.even[i], normals.raw[i]), 1e-5f);
}

// What is taken from one side is given by the other; of a square's two triangles each reaches
// further to its own side.
TEST(EvenNormals, RoundThingsStayRound)
{
    const Mesh column = sheet(24, [](float u, float v) {
        const float angle = u * kPi / 24.0f; // half a column, 7.5 degrees a face
        return glm::vec3(0.2f * std::cos(angle), 0.05f * v, -0.2f * std::sin(angle));
    });
    const Normals normals = normalsOf(column);
    for (size_t i = 0; i < normals.raw.size(); i += 2) {
        const size_t across = i / 2 % 24;
        const size_t along = i / 2 / 24;
        if (across < 6 || across >= 18 || along < 6 || along >= 18) continue; // one side is missing
        const glm::vec3 even = 0.5f * (normals.even[i] + normals.even[i + 1]);
        EXPECT_LT(glm::distance(even, normals.raw[i]), 0.02f);
    }
}

} // namespace relamp
