#include "shading/rooms.h"

#include "base/parallel.h"
#include "shading/openings.h"
#include "shading/room_sights.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace relamp
{
namespace
{

constexpr double kLeastRoom = 12.0; // m^2 of surface: less is a cupboard
constexpr double kGlimpse = 0.001;  // of what a room sees; less lights nothing there
constexpr double kDoor = 0.06;      // of what a room sees; more than is behind a door is the room

// Numerics.
constexpr double kRough = 0.25;       // in place of kDoor where labels do not end at doors yet
constexpr double kFewestSeeds = 256;  // labels at first, evenly among the surfels
constexpr double kMostSeeds = 2048;   // what each two see of each other is 32 MB then
constexpr double kSeedArea = 4.0;     // m^2 of surface a label, in between: some dozens a room
constexpr size_t kHeard = 12;         // rays of a surfel that are heard
constexpr uint32_t kOwn = kHeard / 3; // how many its own label counts for, so that none swing
constexpr int kRounds = 8;

class Labels
{
public:
    Labels(const Texels& texels, const HitLists& hits)
        : surfels_(texels.surfels), hits_(hits), label_(surfels_.count(), kNone)
    {
        const double area = std::accumulate(surfels_.area.begin(), surfels_.area.end(), 0.0);
        seeds_ = static_cast<size_t>(std::clamp(area / kSeedArea, kFewestSeeds, kMostSeeds));
        for (size_t k = 0; k < seeds_; ++k)
            label_[k * label_.size() / seeds_] = static_cast<uint16_t>(k);
    }

    /// Every surfel takes the label that most of what it sees has, again and again.
    void spread()
    {
        for (int round = 0; round < kRounds; ++round) {
            std::vector<uint16_t> next(label_.size());
            forEachChunk(next.size(), 1024, [&](size_t begin, size_t end) {
                std::vector<uint32_t> votes(seeds_, 0);
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
        RoomSights sees = sights();
        const std::vector<double> seen = seenByEach(sees);
        std::vector<Node> nodes;
        for (const double area : seen) nodes.push_back({.seen = area});
        std::vector<size_t> top(seeds_); // node of each label and what was joined into it
        std::iota(top.begin(), top.end(), size_t{0});
        std::vector<uint8_t> isTop(seeds_);
        for (size_t k = 0; k < seeds_; ++k) isTop[k] = seen[k] > 0.0 ? 1 : 0;
        JoinedParts parts(sees, seen);
        while (const auto two = parts.next()) {
            const Node& left = nodes[top[two->into]];
            const Node& right = nodes[top[two->from]];
            const double share = two->ofEachOther / (2.0 * std::min(left.seen, right.seen));
            nodes.push_back({top[two->into], top[two->from], left.seen + right.seen, share});
            top[two->into] = nodes.size() - 1;
            isTop[two->from] = 0;
        }
        std::vector<uint16_t> roomOf(seeds_, kNone);
        for (size_t k = 0; k < seeds_; ++k)
            if (isTop[k] != 0) part(nodes, top[k], false, roomOf);
        rename(roomOf);
    }

    /// Makes one of rooms that see each other by more than a door, most first.
    void join()
    {
        RoomSights sees = sights();
        std::vector<double> seen = seenByEach(sees);
        std::vector<size_t> left;
        for (size_t k = 0; k < seeds_; ++k)
            if (seen[k] > 0.0) left.push_back(k);
        std::vector<uint16_t> roomOf(seeds_);
        std::iota(roomOf.begin(), roomOf.end(), uint16_t{0});
        for (;;) {
            double most = kDoor;
            size_t into = 0;
            size_t from = 0;
            for (auto a = left.begin(); a != left.end(); ++a)
                for (auto b = a + 1; b != left.end(); ++b) {
                    const double least = 2.0 * std::min(seen[*a], seen[*b]);
                    const double both = sees.ofEachOther(*a, *b);
                    if (both <= most * least) continue;
                    most = both / least;
                    into = *a;
                    from = *b;
                }
            if (into == from) break;
            sees.join(into, from);
            seen[into] += seen[from];
            std::erase(left, from);
            std::ranges::replace(roomOf, static_cast<uint16_t>(from), static_cast<uint16_t>(into));
        }
        rename(roomOf);
    }

    /// Keeps the `most` largest, without those that are no rooms, by falling area.
    void keep(size_t most)
    {
        std::vector<double> area(seeds_, 0.0);
        for (size_t s = 0; s < label_.size(); ++s)
            if (label_[s] != kNone) area[label_[s]] += static_cast<double>(surfels_.area[s]);
        std::vector<uint16_t> order(seeds_);
        std::iota(order.begin(), order.end(), uint16_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](uint16_t a, uint16_t b) { return area[a] > area[b]; });
        std::vector<uint16_t> kept(seeds_, kNone);
        for (uint16_t k = 0; k < most && (k == 0 || area[order[k]] > kLeastRoom); ++k)
            kept[order[k]] = k;
        rename(kept);
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
    static constexpr uint16_t kNone = 0xffff;
    struct Node
    {
        size_t left = 0; // nodes that were joined; none of a label by itself, which come first
        size_t right = 0;
        double seen = 0.0;  // m^2
        double share = 1.0; // of what the lesser sees, that is the other
    };

    static std::vector<double> seenByEach(const RoomSights& sees)
    {
        std::vector<double> seen;
        for (size_t k = 0; k < sees.parts(); ++k) seen.push_back(sees.seenBy(k));
        return seen;
    }

    void rename(std::span<const uint16_t> names)
    {
        for (uint16_t& label : label_)
            if (label != kNone) label = names[label];
    }

    /// Gives all labels below a node one room, or each of two that see little of each other its
    /// own; a room has the number of one of its labels.
    static void part(std::span<const Node> nodes, size_t node, bool isOneRoom,
                     std::vector<uint16_t>& roomOf, uint16_t room = kNone)
    {
        const Node& here = nodes[node];
        if (here.left == here.right) {
            roomOf[node] = room == kNone ? static_cast<uint16_t>(node) : room;
            return;
        }
        const double lesser = std::min(nodes[here.left].seen, nodes[here.right].seen);
        isOneRoom = isOneRoom || here.share > kRough;
        if (!isOneRoom && lesser > kLeastRoom) {
            part(nodes, here.left, false, roomOf);
            part(nodes, here.right, false, roomOf);
            return;
        }
        if (room == kNone) room = firstOf(nodes, node);
        part(nodes, here.left, isOneRoom, roomOf, room);
        part(nodes, here.right, isOneRoom, roomOf, room);
    }
    static uint16_t firstOf(std::span<const Node> nodes, size_t node)
    {
        while (nodes[node].left != nodes[node].right) node = nodes[node].left;
        return static_cast<uint16_t>(node);
    }

    [[nodiscard]] RoomSights sights() const
    {
        RoomSights sights(seeds_);
        for (size_t s = 0; s < label_.size(); ++s) {
            if (label_[s] == kNone) continue;
            const std::span<const HitTarget> looks = looksOf(s);
            const auto each =
                static_cast<double>(surfels_.area[s]) / static_cast<double>(looks.size());
            for (const HitTarget target : looks) {
                if (target.isNothing() || target.side().isBack()) continue;
                if (const uint16_t seen = label_[target.side().surfel()]; seen != kNone)
                    sights.add(label_[s], seen, each);
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
    size_t seeds_ = 0;
};

/// As HitLists has them. The stray surfels of a room see another and are few.
std::vector<RoomSet> roomsSeen(const HitLists& hits)
{
    std::vector<std::vector<size_t>> count(hits.rooms, std::vector<size_t>(hits.rooms, 0));
    for (size_t list = 0; list < hits.sideOfList.size(); ++list) {
        std::vector<size_t>& seen = count[hits.roomOfSurfel[hits.sideOfList[list].surfel()]];
        for (const HitTarget target : hits.targetsOf(list))
            if (!target.isNothing()) ++seen[hits.roomOfSurfel[target.side().surfel()]];
    }
    std::vector<RoomSet> rooms(hits.rooms);
    for (size_t r = 0; r < hits.rooms; ++r) {
        const auto all =
            static_cast<double>(std::accumulate(count[r].begin(), count[r].end(), size_t{0}));
        for (size_t q = 0; q < hits.rooms; ++q) {
            const bool isSeen = static_cast<double>(count[r][q]) > kGlimpse * all;
            rooms[r][q] = q == r || isSeen;
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
