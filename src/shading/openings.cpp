#include "shading/openings.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "shading/opening_squares.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace relamp
{
namespace
{

constexpr size_t kMost = 128;
constexpr double kLeastShare = 3e-4;   // of all light that could reach surfaces from there
constexpr double kLeastOutside = 0.01; // of it that all openings together let in
constexpr double kLeastOpening = 3e-3; // the same, of a hole that is no part of the rest

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
std::vector<double> sharesOf(const OpeningSquares& squares, const Texels& texels,
                             const HitLists& hits)
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

Parts partsOf(const OpeningSquares& squares, std::span<const double> shares)
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
        if (whole[opening] < kLeastOpening || parts.count + 2 > HitTarget::kMostOfOpenings) break;
        firstOf[opening] = parts.count;
        parts.count += OpeningSquares::isUpright(squares.sideOf(opening)) ? 2u : 1u;
    }
    for (uint32_t square = 0; square < squares.count(); ++square)
        if (shares[square] >= kLeastShare) parts.ofSquare[square] = firstOf[sets.find(square)];
    return parts;
}

/// Squares just beyond holes in the top and the bottom, which face the room, those first that most
/// rays leave through; what is in an upright side is far.
std::vector<Candidate> squaresOf(const OpeningSquares& squares, std::span<const double> shares,
                                 const Parts& parts)
{
    if (std::accumulate(shares.begin(), shares.end(), 0.0) < kLeastOutside) return {};
    std::vector<size_t> order(shares.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return shares[a] > shares[b]; });
    std::vector<Candidate> openings;
    for (const size_t square : order) {
        if (openings.size() == kMost) break;
        if (parts.ofSquare[square] == 0 || OpeningSquares::isUpright(squares.sideOf(square)))
            continue;
        openings.push_back(squares[square]);
    }
    return openings;
}

/// Where large openings lie, and how large they are: every line out through a hole begins at some
/// front, so that the area of fronts times the share of their rays which leave through it is its
/// area.
std::vector<Hole> holesOf(const OpeningSquares& squares, std::span<const double> shares,
                          const Parts& parts, std::span<const float> areaOfPart)
{
    std::map<uint32_t, std::pair<Hole, double>> holes; // by their first part, with their share
    for (size_t square = 0; square < squares.count(); ++square) {
        const uint32_t part = parts.ofSquare[square];
        if (part == 0) continue;
        auto& [hole, share] = holes[part];
        const Candidate at = squares[square];
        hole.part = part;
        hole.parts = OpeningSquares::isUpright(squares.sideOf(square)) ? 2 : 1;
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
    const OpeningSquares squares(texels.surfels);
    const std::vector<double> shares = sharesOf(squares, texels, hits);
    const Parts parts = partsOf(squares, shares);
    hits.partOfSquare = parts.ofSquare;
    hits.shareOfPart.assign(parts.count, 1.0f);
    if (parts.count == 1) return;
    const SurfelSites sites(texels);
    forEachChunk(hits.sideOfList.size(), 256, [&](size_t begin, size_t end) {
        forEachLeaving(sites, hits, begin, end, [&](HitTarget& target, const Ray& ray) {
            const size_t square = squares.leftBy(ray);
            const uint32_t part = parts.ofSquare[square];
            const bool isBelow = part != 0 && ray.direction.y < 0.0f &&
                                 OpeningSquares::isUpright(squares.sideOf(square));
            target = HitTarget::nothing(part + (isBelow ? 1u : 0u));
        });
    });
    hits.shareOfPart = sharesOfParts(texels, hits, parts.count);
    hits.holes = holesOf(squares, shares, parts, hits.shareOfPart);
    hits.squares = squaresOf(squares, shares, parts);
}

std::vector<float> sharesOfParts(const Texels& texels, const HitLists& hits, size_t parts)
{
    std::vector<float> shares(parts, 0.0f);
    for (size_t s = 0; s < texels.surfels.count(); ++s) {
        const float perRay = texels.surfels.area[s] / static_cast<float>(hits.targetsOf(s).size());
        for (const HitTarget target : hits.targetsOf(s))
            if (target.isNothing()) shares[target.part()] += perRay;
    }
    return shares;
}

} // namespace relamp
