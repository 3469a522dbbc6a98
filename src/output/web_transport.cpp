#include "output/web_transport.h"

#include "output/web_bytes.h"
#include "output/web_clusters.h"
#include "relight/relighter_state.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr size_t kRays = 128; // of a cluster
constexpr size_t kPoints = 8; // of a cluster

/// Even choice of `count` out of what has shares that sum to 1: calls `take(item)`, ascending.
template<class Share, class Take>
void forEachChosen(size_t items, size_t count, const Share& share, const Take& take)
{
    double sum = 0.0;
    size_t taken = 0;
    for (size_t item = 0; item < items; ++item) {
        sum += static_cast<double>(count) * static_cast<double>(share(item));
        for (; taken < count && static_cast<double>(taken) + 0.5 < sum; ++taken) take(item);
    }
    for (; taken < count; ++taken) take(items - 1); // rounding
}

class TransportWriter
{
public:
    explicit TransportWriter(const Relighter::State& room)
        : surfels_(room.texels.surfels), transport_(room.transport),
          albedo_(room.albedo.ofSurfels()), clusters_(webClusters(transport_, surfels_)),
          box_(room.scene.bounds())
    {}

    WebTransport write()
    {
        WebTransport written;
        for (size_t cluster = 0; cluster < clusters_.count; ++cluster)
            addCluster(cluster, written.bytes);
        for (size_t cluster = 0; cluster < clusters_.count; ++cluster)
            addPoints(cluster, written.bytes);
        for (size_t cluster = 0; cluster < clusters_.count; ++cluster)
            addRays(cluster, written.bytes);
        written.json = {{"clusters", clusters_.count},
                        {"fronts", clusters_.fronts},
                        {"size", clusters_.size},
                        {"points", kPoints},
                        {"rays", kRays},
                        {"box", webBox(box_)}};
        return written;
    }

private:
    [[nodiscard]] std::span<const uint32_t> membersOf(size_t cluster) const
    {
        return {clusters_.members.data() + clusters_.first[cluster],
                clusters_.members.data() + clusters_.first[cluster + 1]};
    }
    [[nodiscard]] glm::vec3 normalOf(Side side) const
    {
        const glm::vec3 normal = surfels_.normal[side.surfel()];
        return side.isBack() ? -normal : normal;
    }

    void addCluster(size_t cluster, std::vector<uint8_t>& bytes) const
    {
        glm::vec3 place(0.0f);
        glm::vec3 normal(0.0f);
        glm::vec3 albedo(0.0f);
        for (const uint32_t i : membersOf(cluster)) {
            const Side side = transport_.sides[i];
            place += clusters_.weight[i] * surfels_.position[side.surfel()];
            normal += clusters_.weight[i] * normalOf(side);
            albedo += clusters_.weight[i] * albedo_[side.surfel()];
        }
        if (glm::dot(normal, normal) < 1e-6f)
            normal = normalOf(transport_.sides[membersOf(cluster).front()]);
        addSite(bytes, box_, place, glm::normalize(normal));
        for (int c = 0; c < 3; ++c)
            bytes.push_back(static_cast<uint8_t>(
                std::lround(255.0f * std::sqrt(std::clamp(albedo[c], 0.0f, 1.0f)))));
    }

    void addPoints(size_t cluster, std::vector<uint8_t>& bytes) const
    {
        const std::span<const uint32_t> members = membersOf(cluster);
        forEachChosen(
            members.size(), kPoints, [&](size_t m) { return clusters_.weight[members[m]]; },
            [&](size_t m) {
                const Side side = transport_.sides[members[m]];
                addSite(bytes, box_, surfels_.position[side.surfel()], normalOf(side));
            });
    }

    /// The clusters that the rays of a cluster's members met, by the members' weights: fronts have
    /// many rays of their own, backs those of the transport's own clusters.
    [[nodiscard]] std::vector<float> sharesOf(size_t cluster) const
    {
        std::vector<float> shares(clusters_.count + 1, 0.0f); // and of nothing
        for (const uint32_t i : membersOf(cluster)) {
            const bool isFront = !transport_.sides[i].isBack();
            const SightLists& lists = isFront ? transport_.ofFronts : transport_.ofClusters;
            const std::vector<uint32_t>& coarse = isFront ? clusters_.ofSide : coarse_;
            const size_t list = isFront ? i : transport_.clusterOf[i];
            const size_t rays = lists.first[list + 1] - lists.first[list];
            const float share = clusters_.weight[i] / static_cast<float>(std::max<size_t>(rays, 1));
            for (size_t r = lists.first[list]; r < lists.first[list + 1]; ++r) {
                const uint32_t target = lists.target[r];
                shares[target < coarse.size() ? coarse[target] : clusters_.count] += share;
            }
            if (rays == 0) shares.back() += clusters_.weight[i];
        }
        return shares;
    }

    void addRays(size_t cluster, std::vector<uint8_t>& bytes) const
    {
        const std::vector<float> shares = sharesOf(cluster);
        size_t last = 0;
        forEachChosen(
            shares.size(), kRays, [&](size_t met) { return shares[met]; },
            [&](size_t met) {
                size_t step = met - last;
                last = met;
                for (; step >= 255; step -= 255) bytes.push_back(255);
                bytes.push_back(static_cast<uint8_t>(step));
            });
    }

    /// Of the transport's own clusters, that which their first side is in.
    [[nodiscard]] std::vector<uint32_t> coarseOfFine() const
    {
        std::vector<uint32_t> coarse(transport_.clusters());
        for (size_t i = transport_.sides.size(); i-- > 0;)
            coarse[transport_.clusterOf[i]] = clusters_.ofSide[i];
        return coarse;
    }

    const Surfels& surfels_;
    const Transport& transport_;
    std::span<const glm::vec3> albedo_; // of surfels
    WebClusters clusters_;
    std::vector<uint32_t> coarse_ = coarseOfFine();
    Bounds box_;
};

} // namespace

WebTransport webTransport(const Relighter& relighter)
{
    return TransportWriter(relighter.state()).write();
}

} // namespace relamp
