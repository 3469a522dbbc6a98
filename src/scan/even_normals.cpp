#include "scan/even_normals.h"

#include "base/biweight.shared.h"
#include "base/parallel.h"

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kOneSurface = 0.87f; // rad; beyond, two triangles are of two surfaces
constexpr float kOneFacing = 0.35f;  // rad; the same by guides, which have less noise
constexpr int kRoundsOfGuide = 2;
constexpr int kRounds = 3;

/// Mean of the normals around, weighted by area and by how nearly their guides face the same way.
std::vector<glm::vec3> mean(std::span<const glm::vec3> normals, std::span<const float> area,
                            const VertexFans& fans, std::span<const glm::vec3> guides, float reach)
{
    std::vector<glm::vec3> means(normals.size());
    forEachChunk(normals.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            glm::vec3 sum = area[i] * normals[i];
            for (int corner = 0; corner < 3; ++corner)
                for (const uint32_t other : fans.around(i, corner)) {
                    const glm::vec3 way = guides[other] - guides[i];
                    sum += biweight(glm::dot(way, way) / (reach * reach)) * area[other] *
                           normals[other];
                }
            const float length = glm::length(sum);
            means[i] = length > 0.1f * area[i] ? sum / length : normals[i]; // folded onto itself
        }
    });
    return means;
}

} // namespace

std::vector<glm::vec3> evenNormals(std::span<const glm::vec3> normals, std::span<const float> area,
                                   const VertexFans& fans)
{
    std::vector<glm::vec3> guides(normals.begin(), normals.end());
    for (int round = 0; round < kRoundsOfGuide; ++round)
        guides = mean(guides, area, fans, guides, kOneSurface);
    std::vector<glm::vec3> even(normals.begin(), normals.end());
    for (int round = 0; round < kRounds; ++round) even = mean(even, area, fans, guides, kOneFacing);
    return even;
}

} // namespace relamp
