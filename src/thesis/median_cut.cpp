#include "thesis/median_cut.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/common.hpp>

namespace relamp
{
namespace
{

using Region = std::span<uint32_t>;

int longestAxis(std::span<const CutPoint> points, Region region)
{
    glm::vec3 low = points[region.front()].position;
    glm::vec3 high = low;
    for (const uint32_t i : region) {
        low = glm::min(low, points[i].position);
        high = glm::max(high, points[i].position);
    }
    const glm::vec3 extent = high - low;
    return extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
}

/// Sorts the region along its longest axis and says how many of its points lie below the cut.
size_t cut(std::span<const CutPoint> points, Region region)
{
    const int axis = longestAxis(points, region);
    std::sort(region.begin(), region.end(), [&](uint32_t a, uint32_t b) {
        const float pa = points[a].position[axis];
        const float pb = points[b].position[axis];
        return pa < pb || (pa == pb && a < b);
    });
    double total = 0.0;
    for (const uint32_t i : region) total += static_cast<double>(points[i].energy);
    double below = 0.0;
    for (size_t n = 0; n + 1 < region.size(); ++n) {
        const double with = below + static_cast<double>(points[region[n]].energy);
        if (with >= 0.5 * total) {
            const bool nearerWithout = n > 0 && 0.5 * total - below < with - 0.5 * total;
            return nearerWithout ? n : n + 1;
        }
        below = with;
    }
    return region.size() - 1;
}

} // namespace

std::vector<std::vector<uint32_t>> medianCut(std::span<const CutPoint> points, int levels)
{
    if (points.empty()) return {};
    std::vector<uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0u);
    std::vector<Region> regions{Region(order)};
    for (int level = 0; level < levels; ++level) {
        std::vector<Region> halves;
        for (const Region region : regions) {
            if (region.size() < 2) {
                halves.push_back(region);
                continue;
            }
            const size_t below = cut(points, region);
            halves.push_back(region.first(below));
            halves.push_back(region.subspan(below));
        }
        regions = std::move(halves);
    }
    std::vector<std::vector<uint32_t>> result;
    result.reserve(regions.size());
    for (const Region region : regions) result.emplace_back(region.begin(), region.end());
    return result;
}

} // namespace relamp
