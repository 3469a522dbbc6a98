#include "output/web_clusters.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relamp
{
namespace
{

constexpr size_t kMostClusters = 2048;

struct Key
{
    bool isBack;
    std::array<int, 3> cell;
    uint64_t facing;

    auto operator<=>(const Key&) const = default;
};

std::vector<Key> keysOf(const Transport& transport, const Surfels& surfels, int cells)
{
    std::vector<Key> keys;
    keys.reserve(transport.sides.size());
    for (const Side side : transport.sides) {
        const int across = side.isBack() ? 2 * cells : cells; // hardly any light goes by backs
        const glm::ivec3 cell = surfels.grid.cellOf(surfels.position[side.surfel()]) / across;
        keys.push_back({side.isBack(),
                        {cell.x, cell.y, cell.z},
                        surfels.key[side.surfel()] % SurfelGrid::kFacings / SurfelGrid::kParts});
    }
    return keys;
}

std::vector<Key> distinctOf(std::vector<Key> keys)
{
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return keys;
}

/// By the rays that met a side; of what none met, every side is as much.
std::vector<float> weightsOf(const Transport& transport, const WebClusters& clusters)
{
    std::vector<float> met(transport.sides.size(), 0.0f);
    for (const uint32_t side : transport.ofFronts.target)
        if (side < met.size()) met[side] += 1.0f;
    for (size_t cluster = 0; cluster < clusters.count; ++cluster) {
        const auto begin = clusters.members.begin() + clusters.first[cluster];
        const auto end = clusters.members.begin() + clusters.first[cluster + 1];
        float sum = 0.0f;
        for (auto side = begin; side != end; ++side) sum += met[*side];
        const float share = 1.0f / static_cast<float>(end - begin);
        for (auto side = begin; side != end; ++side)
            met[*side] = sum > 0.0f ? met[*side] / sum : share;
    }
    return met;
}

} // namespace

WebClusters webClusters(const Transport& transport, const Surfels& surfels)
{
    int cells = 1;
    std::vector<Key> keys = keysOf(transport, surfels, cells);
    std::vector<Key> distinct = distinctOf(keys);
    while (distinct.size() > kMostClusters) {
        const double tooMany = static_cast<double>(distinct.size()) / kMostClusters;
        cells = std::max(cells + 1, static_cast<int>(0.9 * cells * std::sqrt(tooMany)));
        keys = keysOf(transport, surfels, cells);
        distinct = distinctOf(keys);
    }
    WebClusters clusters;
    clusters.size = static_cast<float>(cells) * surfels.size;
    clusters.count = distinct.size();
    clusters.first.assign(clusters.count + 1, 0);
    for (const Key& key : keys) {
        const auto found = std::lower_bound(distinct.begin(), distinct.end(), key);
        clusters.ofSide.push_back(static_cast<uint32_t>(found - distinct.begin()));
        ++clusters.first[clusters.ofSide.back() + 1];
    }
    clusters.fronts = static_cast<size_t>(std::count_if(
        distinct.begin(), distinct.end(), [](const Key& key) { return !key.isBack; }));
    for (size_t cluster = 0; cluster < clusters.count; ++cluster)
        clusters.first[cluster + 1] += clusters.first[cluster];
    clusters.members.resize(keys.size());
    std::vector<uint32_t> next(clusters.first.begin(), clusters.first.end() - 1);
    for (uint32_t side = 0; side < keys.size(); ++side)
        clusters.members[next[clusters.ofSide[side]]++] = side;
    clusters.weight = weightsOf(transport, clusters);
    return clusters;
}

} // namespace relamp
