#include "scan/vertex_fans.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace relamp
{
namespace
{

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

} // namespace

VertexFans::VertexFans(const Mesh& mesh)
    : first_(mesh.positions.size() + 1, 0), triangles_(3 * mesh.triangles.size())
{
    const std::vector<uint32_t> placeOfVertex = weld(mesh.positions);
    placeOf_.reserve(triangles_.size());
    for (const glm::uvec3& t : mesh.triangles)
        for (int c = 0; c < 3; ++c) {
            placeOf_.push_back(placeOfVertex[t[c]]);
            ++first_[placeOf_.back() + 1];
        }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
    for (size_t i = 0; i < placeOf_.size(); ++i)
        triangles_[next[placeOf_[i]]++] = static_cast<uint32_t>(i / 3);
}

} // namespace relamp
