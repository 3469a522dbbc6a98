#include "rooms/reconstruct.h"

#include "rooms/paint.h"
#include "scan/finish_mesh.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace relamp::rooms
{
namespace
{

constexpr float kCell = 0.08f;        // m, of the mesh
constexpr float kBump = 0.1f;         // m, of what noise varies over
constexpr float kHole = 0.35f;        // m, the same of holes
constexpr float kNoiseRms = 0.33f;    // of noise()
constexpr float kAlongSurface = 0.3f; // of what vertices are off across it

} // namespace

ChartMesh reconstructed(const Atlas& atlas, const ReconstructOptions& options)
{
    ChartMesh result = meshOf(atlas, kCell);
    Mesh& mesh = result.scan.meshes[0];
    const auto isMissing = [&](const glm::uvec3& t) {
        const glm::vec3 middle =
            (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0f;
        return 0.5f *
                   (1.0f + std::erf(noise(middle / kHole, options.seed) / (kNoiseRms * 1.414f))) <
               options.holes;
    };
    std::vector<glm::uvec3> kept;
    std::vector<uint32_t> chartOf;
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (isMissing(mesh.triangles[t])) continue;
        kept.push_back(mesh.triangles[t]);
        chartOf.push_back(result.chartOf[t]);
    }
    std::vector<glm::vec3> normals(mesh.positions.size(), glm::vec3(0.0f));
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 normal = glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                            mesh.positions[t.z] - mesh.positions[t.x]);
        for (int c = 0; c < 3; ++c) normals[t[c]] += normal;
    }
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 at = mesh.positions[i] / kBump;
        const auto off = [&](uint64_t salt) {
            return options.noise / kNoiseRms * noise(at, options.seed + salt);
        };
        mesh.positions[i] +=
            off(1) * glm::normalize(normals[i]) + kAlongSurface * glm::vec3(off(2), off(3), off(4));
    }
    mesh.triangles = std::move(kept);
    result.chartOf = std::move(chartOf);
    mesh.normals.clear();
    finishMesh(mesh, {}, "room", result.scan.warnings);
    return result;
}

} // namespace relamp::rooms
