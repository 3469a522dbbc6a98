#include "shading/rooms.h"

#include "base/parallel.h"
#include "shading/openings.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

namespace relamp
{
namespace
{

constexpr double kLeastRoom = 0.02; // of all surfaces: less is a cupboard
constexpr double kGlimpse = 0.001;  // of what a room sees; less lights nothing there
constexpr double kDoor = 0.06;      // of what a room sees; more than is behind a door is the room

// Numerics.
constexpr double kRough = 0.25;       // in place of kDoor where labels do not end at doors yet
constexpr uint32_t kSeeds = 256;      // labels at first, evenly among the surfels
constexpr size_t kHeard = 12;         // rays of a surfel that are heard
constexpr uint32_t kOwn = kHeard / 3; // how many its own label counts for, so that none swing
constexpr int kRounds = 8;

class Labels
{
public:
    Labels(const Texels& texels, const HitLists& hits)
        : surfels_(texels.surfels), hits_(hits), label_(surfels_.count(), kNone)
    {
        for (uint32_t k = 0; k < kSeeds; ++k)
            label_[static_cast<size_t>(k) * label_.size() / kSeeds] = static_cast<uint16_t>(k);
    }

    /// Every surfel takes the label that most of what it sees has, again and again.
    void spread()
    {
        for (int round = 0; round < kRounds; ++round) {
            std::vector<uint16_t> next(label_.size());
            forEachChunk(next.size(), 1024, [&](size_t begin, size_t end) {
                std::vector<uint32_t> votes(kSeeds, 0);
                for (size_t s = begin; s < end; ++s) next[s] = votedBy(s, votes);
            });
            if (next == label_) return;
            label_ = std::move(next);
        }
    }

    /// Makes one label of all that are of one room, roughly: what sees each other most is joined
    /// first, and then what was joined last is parted again where that is by little.
    void group()
    {
        Sights sees = sights();
        std::vector<Node> nodes;
        for (const double seen : sumsOf(sees)) nodes.push_back({.seen = seen});
        std::vector<size_t> tops(kSeeds); // node of each row of `sees` that is left
        std::iota(tops.begin(), tops.end(), size_t{0});
        std::erase_if(tops, [&](size_t k) { return nodes[k].seen <= 0.0; });
        std::vector<size_t> rows = tops;
        while (const auto pair = nearest(sees, rows, tops, nodes)) {
            const auto [a, b] = *pair;
            const double both = sees[rows[a]][rows[b]] + sees[rows[b]][rows[a]];
            const Node& left = nodes[tops[a]];
            const Node& right = nodes[tops[b]];
            const double share = both / (2.0 * std::min(left.seen, right.seen));
            nodes.push_back({tops[a], tops[b], left.seen + right.seen, share});
            addTo(sees, rows[a], rows[b]);
            tops[a] = nodes.size() - 1;
            tops.erase(tops.begin() + static_cast<std::ptrdiff_t>(b));
            rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(b));
        }
        double all = 0.0;
        for (const size_t top : tops) all += nodes[top].seen;
        std::vector<uint16_t> roomOf(kSeeds + 1, kNone);
        for (const size_t top : tops) part(nodes, top, kLeastRoom * all, false, roomOf);
        for (uint16_t& label : label_) label = roomOf[label];
    }

    /// Makes one of rooms that see each other by more than a door, most first.
    void join()
    {
        Sights sees = sights();
        std::vector<double> seen = sumsOf(sees);
        std::vector<uint16_t> roomOf(kSeeds + 1);
        std::iota(roomOf.begin(), roomOf.end(), uint16_t{0});
        for (;;) {
            double most = kDoor;
            size_t into = 0;
            size_t from = 0;
            for (size_t a = 0; a < kSeeds; ++a)
                for (size_t b = a + 1; b < kSeeds; ++b) {
                    const double least = 2.0 * std::min(seen[a], seen[b]);
                    if (least <= 0.0 || sees[a][b] + sees[b][a] <= most * least) continue;
                    most = (sees[a][b] + sees[b][a]) / least;
                    into = a;
                    from = b;
                }
            if (into == from) break;
            addTo(sees, into, from);
            seen[into] += std::exchange(seen[from], 0.0);
            std::replace(roomOf.begin(), roomOf.end() - 1, static_cast<uint16_t>(from),
                         static_cast<uint16_t>(into));
        }
        for (uint16_t& label : label_) label = roomOf[label];
    }

    /// Keeps the `most` largest, without those that are no rooms, by falling area.
    void keep(size_t most)
    {
        std::vector<double> area(kSeeds, 0.0);
        for (size_t s = 0; s < label_.size(); ++s)
            if (label_[s] != kNone) area[label_[s]] += static_cast<double>(surfels_.area[s]);
        const double least =
            kLeastRoom * std::accumulate(surfels_.area.begin(), surfels_.area.end(), 0.0);
        std::vector<uint16_t> order(kSeeds);
        std::iota(order.begin(), order.end(), uint16_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](uint16_t a, uint16_t b) { return area[a] > area[b]; });
        std::vector<uint16_t> kept(kSeeds, kNone);
        for (uint16_t k = 0; k < most && (k == 0 || area[order[k]] > least); ++k)
            kept[order[k]] = k;
        for (uint16_t& label : label_)
            if (label != kNone) label = kept[label];
    }

    /// What sees no room is of the one that the surface around it is in, or else of the one beside
    /// it along the curve through space that surfels are sorted by.
    void fill()
    {
        std::vector<uint16_t> known = label_;
        for (size_t s = 0; s < label_.size(); ++s) {
            if (label_[s] != kNone) continue;
            for (const uint32_t n : surfels_.neighborsOf(s))
                if (known[s] == kNone) known[s] = label_[n];
        }
        label_ = std::move(known);
        for (size_t s = 1; s < label_.size(); ++s)
            if (label_[s] == kNone) label_[s] = label_[s - 1];
    }

    [[nodiscard]] std::vector<uint8_t> numbers() const
    {
        std::vector<uint8_t> numbers(label_.size(), 0);
        for (size_t s = 0; s < numbers.size(); ++s)
            if (label_[s] != kNone) numbers[s] = static_cast<uint8_t>(label_[s]);
        return numbers;
    }

private:
    static constexpr uint16_t kNone = kSeeds;
    using Sights = std::vector<std::vector<double>>; // [label][label that it sees]: m^2
    struct Node
    {
        size_t left = 0; // nodes that were joined; none of a label by itself, of the first kSeeds
        size_t right = 0;
        double seen = 0.0;  // m^2
        double share = 1.0; // of what the lesser sees, that is the other
    };

    static std::vector<double> sumsOf(const Sights& sees)
    {
        std::vector<double> sums;
        for (const auto& row : sees) sums.push_back(std::accumulate(row.begin(), row.end(), 0.0));
        return sums;
    }

    /// Both see, and are seen, as one.
    static void addTo(Sights& sees, size_t into, size_t from)
    {
        for (size_t k = 0; k < kSeeds; ++k) sees[into][k] += sees[from][k];
        for (size_t k = 0; k < kSeeds; ++k) sees[k][into] += sees[k][from];
    }

    /// Which two see most of each other beside what they would by their sizes alone: a < b.
    [[nodiscard]] static std::optional<std::pair<size_t, size_t>>
    nearest(const Sights& sees, std::span<const size_t> rows, std::span<const size_t> tops,
            std::span<const Node> nodes)
    {
        std::optional<std::pair<size_t, size_t>> best;
        double most = 0.0;
        for (size_t a = 0; a < rows.size(); ++a)
            for (size_t b = a + 1; b < rows.size(); ++b) {
                const double near = (sees[rows[a]][rows[b]] + sees[rows[b]][rows[a]]) /
                                    (nodes[tops[a]].seen * nodes[tops[b]].seen);
                if (near <= most) continue;
                most = near;
                best = {a, b};
            }
        return best;
    }

    /// Gives all labels below a node one room, or each of two that see little of each other its
    /// own; a room has the number of one of its labels.
    static void part(std::span<const Node> nodes, size_t node, double least, bool isOneRoom,
                     std::vector<uint16_t>& roomOf, uint16_t room = kNone)
    {
        const Node& here = nodes[node];
        if (here.left == here.right) {
            roomOf[node] = room == kNone ? static_cast<uint16_t>(node) : room;
            return;
        }
        const double lesser = std::min(nodes[here.left].seen, nodes[here.right].seen);
        isOneRoom = isOneRoom || here.share > kRough;
        if (!isOneRoom && lesser > least) {
            part(nodes, here.left, least, false, roomOf);
            part(nodes, here.right, least, false, roomOf);
            return;
        }
        if (room == kNone) room = firstOf(nodes, node);
        part(nodes, here.left, least, isOneRoom, roomOf, room);
        part(nodes, here.right, least, isOneRoom, roomOf, room);
    }
    static uint16_t firstOf(std::span<const Node> nodes, size_t node)
    {
        while (nodes[node].left != nodes[node].right) node = nodes[node].left;
        return static_cast<uint16_t>(node);
    }

    [[nodiscard]] Sights sights() const
    {
        Sights sights(kSeeds, std::vector<double>(kSeeds, 0.0));
        for (size_t s = 0; s < label_.size(); ++s) {
            if (label_[s] == kNone) continue;
            const std::span<const HitTarget> looks = looksOf(s);
            const auto each =
                static_cast<double>(surfels_.area[s]) / static_cast<double>(looks.size());
            for (const HitTarget target : looks) {
                if (target.isNothing() || target.side().isBack()) continue;
                if (const uint16_t seen = label_[target.side().surfel()]; seen != kNone)
                    sights[label_[s]][seen] += each;
            }
        }
        return sights;
    }

    [[nodiscard]] std::span<const HitTarget> looksOf(size_t s) const
    {
        const std::span<const HitTarget> targets = hits_.targetsOf(s); // a front's list is its own
        return targets.first(std::min(kHeard, targets.size()));
    }

    /// The one of the least number where several have as many. `votes` is all 0 before and after.
    [[nodiscard]] uint16_t votedBy(size_t s, std::span<uint32_t> votes) const
    {
        const std::span<const HitTarget> looks = looksOf(s);
        if (label_[s] != kNone) votes[label_[s]] = kOwn;
        uint16_t best = label_[s];
        for (const HitTarget target : looks) {
            if (target.isNothing() || target.side().isBack()) continue;
            const uint16_t seen = label_[target.side().surfel()];
            if (seen == kNone) continue;
            ++votes[seen];
            if (best == kNone || votes[seen] > votes[best] ||
                (votes[seen] == votes[best] && seen < best))
                best = seen;
        }
        if (label_[s] != kNone) votes[label_[s]] = 0;
        for (const HitTarget target : looks)
            if (!target.isNothing())
                if (const uint16_t seen = label_[target.side().surfel()]; seen != kNone)
                    votes[seen] = 0;
        return best;
    }

    const Surfels& surfels_;
    const HitLists& hits_;
    std::vector<uint16_t> label_; // of surfels
};

/// As HitLists has them. The stray surfels of a room see another and are few.
std::vector<uint64_t> roomsSeen(const HitLists& hits)
{
    std::vector<std::vector<size_t>> count(hits.rooms, std::vector<size_t>(hits.rooms, 0));
    for (size_t list = 0; list < hits.sideOfList.size(); ++list) {
        std::vector<size_t>& seen = count[hits.roomOfSurfel[hits.sideOfList[list].surfel()]];
        for (const HitTarget target : hits.targetsOf(list))
            if (!target.isNothing()) ++seen[hits.roomOfSurfel[target.side().surfel()]];
    }
    std::vector<uint64_t> rooms(hits.rooms, 0);
    for (size_t r = 0; r < hits.rooms; ++r) {
        const auto all =
            static_cast<double>(std::accumulate(count[r].begin(), count[r].end(), size_t{0}));
        for (size_t q = 0; q < hits.rooms; ++q) {
            const bool isSeen = static_cast<double>(count[r][q]) > kGlimpse * all;
            if (q == r || isSeen) rooms[r] |= uint64_t{1} << q;
        }
    }
    return rooms;
}

} // namespace

std::vector<uint8_t> roomsOfSurfels(const Texels& texels, const HitLists& hits, size_t most)
{
    if (texels.surfels.count() == 0) return {};
    Labels labels(texels, hits);
    labels.spread();
    labels.group();
    labels.spread();
    labels.join();
    labels.keep(most);
    labels.spread();
    labels.fill();
    return labels.numbers();
}

void tellRoomsApart(const Texels& texels, std::vector<uint8_t> roomOfSurfel, HitLists& hits)
{
    if (roomOfSurfel.empty()) return;
    const auto behind = static_cast<uint32_t>(hits.shareOfPart.size());
    hits.rooms = 1 + *std::max_element(roomOfSurfel.begin(), roomOfSurfel.end());
    if (hits.rooms == 1) return;
    forEachChunk(hits.sideOfList.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t list = begin; list < end; ++list) {
            const uint32_t room = roomOfSurfel[hits.sideOfList[list].surfel()];
            if (room == 0) continue;
            for (uint32_t t = hits.firstTarget[list]; t < hits.firstTarget[list + 1]; ++t)
                if (hits.targets[t].isNothing() && hits.targets[t].part() == 0)
                    hits.targets[t] = HitTarget::nothing(behind + room - 1);
        }
    });
    hits.shareOfPart = sharesOfParts(texels, hits, behind + hits.rooms - 1);
    hits.roomOfSurfel = std::move(roomOfSurfel);
    hits.roomsSeen = roomsSeen(hits);
}

} // namespace relamp
