#include "relight/transport.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "relight/sky_bins.h"

#include <algorithm>
#include <numeric>

namespace relamp
{
namespace
{

constexpr size_t kRaysOfCluster = 32;
constexpr float kLargestCluster = 0.13f; // m; beyond, surfels stay alone

/// Sides of one place and orientation have one key.
struct ClusterKey
{
    uint64_t cell;
    uint64_t facing; // and side

    auto operator<=>(const ClusterKey&) const = default;
};

ClusterKey keyOf(const Surfels& surfels, Side side)
{
    const uint64_t key = surfels.key[side.surfel()];
    const uint64_t cell = key / SurfelGrid::kFacings;
    const bool isJoined = 2.0f * surfels.size <= kLargestCluster;
    return {isJoined ? cell / 8 : cell, // eight cells of a Morton curve are a cube
            2 * (key % SurfelGrid::kFacings) + (side.isBack() ? 1 : 0)};
}

std::vector<uint32_t> clustersOf(const Texels& texels, std::span<const Side> sides)
{
    std::vector<ClusterKey> keys;
    for (const Side side : sides) keys.push_back(keyOf(texels.surfels, side));
    std::vector<ClusterKey> distinct = keys;
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    std::vector<uint32_t> clusters(keys.size());
    forEachChunk(keys.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            clusters[i] = static_cast<uint32_t>(
                std::lower_bound(distinct.begin(), distinct.end(), keys[i]) - distinct.begin());
    });
    return clusters;
}

/// How much of its cluster each side is to those who see it: by the rays that met it. What stands
/// hidden among others is never met, and counts for nothing.
std::vector<float> weightsOf(const HitLists& hits, std::span<const uint32_t> clusterOf,
                             size_t clusters)
{
    std::vector<float> met(clusterOf.size(), 0.0f);
    for (const HitTarget target : hits.targets) {
        if (target.isNothing()) continue;
        const int32_t list = hits.listOfSide[target.side().index];
        if (list != HitLists::kNoList) met[static_cast<size_t>(list)] += 1.0f;
    }
    std::vector<float> sums(clusters, 0.0f);
    std::vector<float> members(clusters, 0.0f);
    for (size_t i = 0; i < met.size(); ++i) {
        sums[clusterOf[i]] += met[i];
        members[clusterOf[i]] += 1.0f;
    }
    for (size_t i = 0; i < met.size(); ++i) {
        const uint32_t cluster = clusterOf[i];
        met[i] = sums[cluster] > 0.0f ? met[i] / sums[cluster] : 1.0f / members[cluster];
    }
    return met;
}

/// Turns what rays met into indices of radiances: `indexOf` are those of lists, `count` of them.
class Lookup
{
public:
    Lookup(const Texels& texels, const HitLists& hits, std::span<const uint32_t> indexOf,
           size_t count)
        : sites_(texels), hits_(hits), indexOf_(indexOf), sky_(static_cast<uint32_t>(count)),
          dark_(static_cast<uint32_t>(count + SkyBins::kCount))
    {}

    /// Of ray `i` of a list.
    [[nodiscard]] uint32_t operator()(size_t list, size_t i) const
    {
        const HitTarget target = hits_.targetsOf(list)[i];
        if (target.isNothing()) {
            const Ray ray = RaysOfSide(sites_, hits_.sideOfList[list])[i];
            return sky_ + static_cast<uint32_t>(SkyBins::of(ray.direction));
        }
        const int32_t met = hits_.listOfSide[target.side().index];
        return met == HitLists::kNoList ? dark_ : indexOf_[static_cast<size_t>(met)];
    }

private:
    SurfelSites sites_;
    const HitLists& hits_;
    std::span<const uint32_t> indexOf_;
    uint32_t sky_;
    uint32_t dark_;
};

SightLists listsOfFronts(const Lookup& lookup, const HitLists& hits, size_t surfels)
{
    SightLists lists;
    lists.first.assign(hits.firstTarget.begin(),
                       hits.firstTarget.begin() + static_cast<std::ptrdiff_t>(surfels) + 1);
    lists.target.resize(lists.first.back());
    forEachChunk(surfels, 256, [&](size_t begin, size_t end) {
        for (size_t list = begin; list < end; ++list) {
            uint32_t* out = &lists.target[lists.first[list]];
            const size_t count = lists.first[list + 1] - lists.first[list];
            for (size_t i = 0; i < count; ++i) out[i] = lookup(list, i);
            std::sort(out, out + count); // neighbours in memory, one after the other
        }
    });
    return lists;
}

/// Members lend their rays by weight.
SightLists listsOfClusters(const Lookup& lookup, const HitLists& hits, const Transport& transport,
                           size_t clusters)
{
    std::vector<std::vector<uint32_t>> members(clusters);
    for (uint32_t list = 0; list < transport.clusterOf.size(); ++list)
        members[transport.clusterOf[list]].push_back(list);
    SightLists lists;
    for (size_t cluster = 0; cluster < clusters; ++cluster) {
        float owed = 0.0f; // rays, with what rounding left of the members before
        for (const uint32_t list : members[cluster]) {
            owed += static_cast<float>(kRaysOfCluster) * transport.weight[list];
            const size_t count =
                std::min(static_cast<size_t>(owed + 0.5f), hits.targetsOf(list).size());
            owed -= static_cast<float>(count);
            for (size_t i = 0; i < count; ++i) lists.target.push_back(lookup(list, i));
        }
        const auto begin = static_cast<std::ptrdiff_t>(lists.first.back());
        std::sort(lists.target.begin() + begin, lists.target.end());
        lists.first.push_back(static_cast<uint32_t>(lists.target.size()));
    }
    return lists;
}

} // namespace

void SightLists::gather(std::span<const glm::vec4> radiance, std::span<glm::vec4> irradiance,
                        size_t step) const
{
    forEachChunk(count(), 512, [&](size_t begin, size_t end) {
        for (size_t list = begin; list < end; ++list) {
            const uint32_t* targets = target.data() + first[list];
            const size_t rays = first[list + 1] - first[list];
            size_t i = std::min(list % step, rays - 1);
            const size_t taken = (rays - i + step - 1) / step;
            glm::vec4 a(0.0f); // four sums, for an addition takes its time
            glm::vec4 b(0.0f);
            glm::vec4 c(0.0f);
            glm::vec4 d(0.0f);
            for (; i + 3 * step < rays; i += 4 * step) {
                a += radiance[targets[i]];
                b += radiance[targets[i + step]];
                c += radiance[targets[i + 2 * step]];
                d += radiance[targets[i + 3 * step]];
            }
            for (; i < rays; i += step) a += radiance[targets[i]];
            irradiance[list] = (kPi / static_cast<float>(taken)) * ((a + b) + (c + d));
        }
    });
}

size_t Transport::radiancesBeyond()
{
    return SkyBins::kCount + 1;
}

Transport transportOf(const Texels& texels, const HitLists& hits)
{
    Transport transport;
    transport.sides = hits.sideOfList;
    transport.clusterOf = clustersOf(texels, transport.sides);
    const size_t clusters =
        size_t{*std::max_element(transport.clusterOf.begin(), transport.clusterOf.end())} + 1;
    transport.weight = weightsOf(hits, transport.clusterOf, clusters);
    std::vector<uint32_t> itself(transport.sides.size());
    std::iota(itself.begin(), itself.end(), 0u);
    transport.ofFronts =
        listsOfFronts(Lookup(texels, hits, itself, itself.size()), hits, texels.surfels.count());
    transport.ofClusters = listsOfClusters(Lookup(texels, hits, transport.clusterOf, clusters),
                                           hits, transport, clusters);
    return transport;
}

} // namespace relamp
