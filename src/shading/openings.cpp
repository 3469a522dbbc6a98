#include "shading/openings.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace relamp
{
namespace
{

constexpr float kBeyond = 0.2f; // m behind the outermost surface that an unseen one may stand
constexpr float kSquare = 0.5f; // m
constexpr float kMostSquares =
    256.0f; // along a side: in a landscape, or a scan in millimetres, they are larger
constexpr size_t kMost = 128;
constexpr int kAcross = 5;             // patches of a square
constexpr double kLeastShare = 3e-4;   // of all light that could reach surfaces from there
constexpr double kLeastOutside = 0.01; // of it that all openings together let in
constexpr double kLeastOpening = 3e-3; // the same, of a hole that is no part of the rest
constexpr double kCrumbs = 0.003;      // of a scan's surface that may lie beyond its room

/// Along the walls.
struct Box
{
    WallFrame frame;
    glm::vec3 low{0.0f}; // in the frame
    glm::vec3 high{0.0f};
};

/// That holds a scan but for its crumbs.
Box boxAround(const Surfels& surfels)
{
    const double all = std::accumulate(surfels.area.begin(), surfels.area.end(), 0.0);
    Box box{.frame = surfels.grid.frame()};
    std::vector<glm::vec3> position(surfels.count());
    for (size_t s = 0; s < position.size(); ++s)
        position[s] = box.frame.fromScan(surfels.position[s]);
    std::vector<uint32_t> order(surfels.count());
    std::iota(order.begin(), order.end(), 0u);
    for (int axis = 0; axis < 3; ++axis) {
        std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
            return std::pair(position[a][axis], a) < std::pair(position[b][axis], b);
        });
        double below = 0.0;
        for (const uint32_t s : order) {
            if (below <= kCrumbs * all) box.low[axis] = position[s][axis];
            if (below <= (1.0 - kCrumbs) * all) box.high[axis] = position[s][axis];
            below += static_cast<double>(surfels.area[s]);
        }
    }
    box.low -= kScanError;
    box.high += kScanError;
    return box;
}

/// The sides of a box, cut into squares.
class Squares
{
public:
    explicit Squares(const Box& box) : box_(box)
    {
        const glm::vec3 extent = box.high - box.low;
        const float longest = std::max({extent.x, extent.y, extent.z});
        const float size = std::max(kSquare, longest / kMostSquares);
        size_t first = 0;
        for (int side = 0; side < 6; ++side) {
            const auto [u, v] = across(side);
            for (const int axis : {u, v})
                counts_[static_cast<size_t>(side)][axis == u ? 0 : 1] = std::max(
                    static_cast<int>(std::lround((box.high[axis] - box.low[axis]) / size)), 1);
            first_[static_cast<size_t>(side)] = first;
            first += static_cast<size_t>(counts_[static_cast<size_t>(side)][0]) *
                     static_cast<size_t>(counts_[static_cast<size_t>(side)][1]);
        }
        count_ = first;
    }

    [[nodiscard]] size_t count() const { return count_; }

    /// The square that a ray leaves through. One from outside of the box begins at its side.
    [[nodiscard]] size_t leftBy(const Ray& ray) const
    {
        const glm::vec3 origin = glm::clamp(box_.frame.fromScan(ray.origin), box_.low, box_.high);
        const glm::vec3 direction = box_.frame.fromScan(ray.direction);
        float nearest = std::numeric_limits<float>::max();
        int side = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (direction[axis] == 0.0f) continue;
            const bool isUp = direction[axis] > 0.0f;
            const float distance =
                ((isUp ? box_.high[axis] : box_.low[axis]) - origin[axis]) / direction[axis];
            if (distance >= nearest) continue;
            nearest = distance;
            side = 2 * axis + (isUp ? 1 : 0);
        }
        const glm::vec3 at = (origin + nearest * direction - box_.low) / (box_.high - box_.low);
        const auto [u, v] = across(side);
        const auto& counts = counts_[static_cast<size_t>(side)];
        const auto place = [](float share, int of) {
            return static_cast<size_t>(
                std::clamp(static_cast<int>(share * static_cast<float>(of)), 0, of - 1));
        };
        return first_[static_cast<size_t>(side)] +
               place(at[v], counts[1]) * static_cast<size_t>(counts[0]) + place(at[u], counts[0]);
    }

    /// What may stand before a square, unseen.
    [[nodiscard]] Candidate operator[](size_t square) const
    {
        const size_t side = sideOf(square);
        const size_t at = square - first_[side];
        const auto [u, v] = across(static_cast<int>(side));
        const auto axis = static_cast<int>(side / 2);
        const glm::vec3 size = box_.high - box_.low;
        const float width = size[u] / static_cast<float>(counts_[side][0]);
        const float height = size[v] / static_cast<float>(counts_[side][1]);
        const auto column = static_cast<float>(at % static_cast<size_t>(counts_[side][0]));
        const auto row = static_cast<float>(at / static_cast<size_t>(counts_[side][0]));
        ClippedPatch patch{.area = width * height / static_cast<float>(kAcross * kAcross),
                           .surfel = Surfels::kNone};
        patch.normal[axis] = side % 2 != 0 ? -1.0f : 1.0f;
        patch.position[axis] = side % 2 != 0 ? box_.high[axis] + kBeyond : box_.low[axis] - kBeyond;
        std::vector<ClippedPatch> patches;
        for (int i = 0; i < kAcross * kAcross; ++i) {
            const float right = (static_cast<float>(i % kAcross) + 0.5f) / kAcross;
            const float up = (static_cast<float>(i / kAcross) + 0.5f) / kAcross;
            patch.position[u] = box_.low[u] + (column + right) * width;
            patch.position[v] = box_.low[v] + (row + up) * height;
            patches.push_back(patch);
        }
        for (ClippedPatch& each : patches) {
            each.position = box_.frame.toScan(each.position);
            each.normal = box_.frame.toScan(each.normal);
        }
        return candidateOf(std::move(patches));
    }

    [[nodiscard]] size_t sideOf(size_t square) const
    {
        size_t side = 5;
        while (first_[side] > square) --side;
        return side;
    }
    static bool isUpright(size_t side) { return side / 2 != 1; }

    /// Calls `visit(square, other)` for all squares beside each other on one side.
    template<class Visit>
    void forEachBeside(const Visit& visit) const
    {
        for (size_t square = 0; square < count_; ++square) {
            const size_t side = sideOf(square);
            const auto columns = static_cast<size_t>(counts_[side][0]);
            const size_t end = first_[side] + columns * static_cast<size_t>(counts_[side][1]);
            if ((square - first_[side] + 1) % columns != 0) visit(square, square + 1);
            if (square + columns < end) visit(square, square + columns);
        }
    }

private:
    /// The two axes along a side.
    static std::pair<int, int> across(int side) { return {(side / 2 + 1) % 3, (side / 2 + 2) % 3}; }

    Box box_;
    std::array<std::array<int, 2>, 6> counts_{};
    std::array<size_t, 6> first_{};
    size_t count_ = 0;
};

/// Calls `visit(target, ray)` for what is nothing of lists [begin, end).
template<class Hits, class Visit>
void forEachLeaving(const SurfelSites& sites, Hits& hits, size_t begin, size_t end,
                    const Visit& visit)
{
    for (size_t list = begin; list < end; ++list) {
        const auto first = hits.targets.begin() + hits.firstTarget[list];
        const auto last = hits.targets.begin() + hits.firstTarget[list + 1];
        const auto isNothing = [](HitTarget target) { return target.isNothing(); };
        if (std::none_of(first, last, isNothing)) continue;
        const RaysOfSide rays(sites, hits.sideOfList[list]);
        for (auto target = first; target != last; ++target)
            if (target->isNothing()) visit(*target, rays[static_cast<size_t>(target - first)]);
    }
}

/// By squares, of all light that could reach the surfaces of a scan.
std::vector<double> sharesOf(const Squares& squares, const Texels& texels, const HitLists& hits)
{
    const SurfelSites sites(texels);
    std::vector<double> shares(squares.count(), 0.0);
    double all = 0.0;
    for (size_t s = 0; s < texels.surfels.count(); ++s) {
        const auto area = static_cast<double>(texels.surfels.area[s]);
        all += area;
        const auto rays = static_cast<double>(hits.targetsOf(s).size());
        forEachLeaving(sites, hits, s, s + 1, [&](HitTarget, const Ray& ray) {
            shares[squares.leftBy(ray)] += area / rays;
        });
    }
    for (double& share : shares) share /= all;
    return shares;
}

struct Parts
{
    std::vector<uint32_t> ofSquare; // the first of its opening; 0: the rest
    uint32_t count = 1;
};

Parts partsOf(const Squares& squares, std::span<const double> shares)
{
    DisjointSets sets(squares.count());
    squares.forEachBeside([&](size_t a, size_t b) {
        if (shares[a] >= kLeastShare && shares[b] >= kLeastShare)
            sets.join(static_cast<uint32_t>(a), static_cast<uint32_t>(b));
    });
    std::vector<double> whole(squares.count(), 0.0);
    for (uint32_t square = 0; square < whole.size(); ++square)
        if (shares[square] >= kLeastShare) whole[sets.find(square)] += shares[square];
    std::vector<uint32_t> order(squares.count());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return whole[a] > whole[b]; });
    std::vector<uint32_t> firstOf(squares.count(), 0);
    Parts parts{std::vector<uint32_t>(squares.count(), 0)};
    for (const uint32_t opening : order) {
        if (whole[opening] < kLeastOpening || parts.count + 2 > HitTarget::kMostParts) break;
        firstOf[opening] = parts.count;
        parts.count += Squares::isUpright(squares.sideOf(opening)) ? 2u : 1u;
    }
    for (uint32_t square = 0; square < squares.count(); ++square)
        if (shares[square] >= kLeastShare) parts.ofSquare[square] = firstOf[sets.find(square)];
    return parts;
}

/// Where large openings lie, and how large they are: every line out through a hole begins at some
/// front, so that the area of fronts times the share of their rays which leave through it is its
/// area.
std::vector<Hole> holesOf(const Squares& squares, std::span<const double> shares,
                          const Parts& parts, std::span<const float> areaOfPart)
{
    std::map<uint32_t, std::pair<Hole, double>> holes; // by their first part, with their share
    for (size_t square = 0; square < squares.count(); ++square) {
        const uint32_t part = parts.ofSquare[square];
        if (part == 0) continue;
        auto& [hole, share] = holes[part];
        const Candidate at = squares[square];
        hole.part = part;
        hole.parts = Squares::isUpright(squares.sideOf(square)) ? 2 : 1;
        hole.normal = at.normal;
        hole.centre += static_cast<float>(shares[square]) * at.centre;
        share += shares[square];
    }
    std::vector<Hole> list;
    for (auto& [part, found] : holes) {
        Hole& hole = list.emplace_back(found.first);
        hole.centre /= static_cast<float>(found.second);
        for (uint32_t p = part; p < part + hole.parts; ++p) hole.area += areaOfPart[p];
    }
    std::erase_if(list, [](const Hole& hole) { return hole.area < kPaneArea; });
    std::stable_sort(list.begin(), list.end(),
                     [](const Hole& a, const Hole& b) { return a.area > b.area; });
    return list;
}

} // namespace

void tellPartsApart(const Texels& texels, HitLists& hits)
{
    const Squares squares(boxAround(texels.surfels));
    const std::vector<double> shares = sharesOf(squares, texels, hits);
    const Parts parts = partsOf(squares, shares);
    hits.shareOfPart.assign(parts.count, parts.count > 1 ? 0.0f : 1.0f);
    if (parts.count == 1) return;
    const SurfelSites sites(texels);
    forEachChunk(hits.sideOfList.size(), 256, [&](size_t begin, size_t end) {
        forEachLeaving(sites, hits, begin, end, [&](HitTarget& target, const Ray& ray) {
            const size_t square = squares.leftBy(ray);
            const uint32_t part = parts.ofSquare[square];
            const bool isBelow =
                part != 0 && ray.direction.y < 0.0f && Squares::isUpright(squares.sideOf(square));
            target = HitTarget::nothing(part + (isBelow ? 1u : 0u));
        });
    });
    for (size_t s = 0; s < texels.surfels.count(); ++s) {
        const float perRay = texels.surfels.area[s] / static_cast<float>(hits.targetsOf(s).size());
        for (const HitTarget target : hits.targetsOf(s))
            if (target.isNothing()) hits.shareOfPart[target.part()] += perRay;
    }
    hits.holes = holesOf(squares, shares, parts, hits.shareOfPart);
}

std::vector<Candidate> openingsOf(const Texels& texels, const HitLists& hits)
{
    if (hits.shareOfPart.size() == 1) return {};
    const Squares squares(boxAround(texels.surfels));
    const std::vector<double> shares = sharesOf(squares, texels, hits);
    if (std::accumulate(shares.begin(), shares.end(), 0.0) < kLeastOutside) return {};
    std::vector<size_t> order(shares.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return shares[a] > shares[b]; });
    const Parts parts = partsOf(squares, shares);
    std::vector<Candidate> openings;
    for (const size_t square : order) {
        if (openings.size() == kMost) break;
        if (parts.ofSquare[square] == 0) continue;                // a small hole
        if (Squares::isUpright(squares.sideOf(square))) continue; // what is there is far
        openings.push_back(squares[square]);
    }
    return openings;
}

} // namespace relamp
