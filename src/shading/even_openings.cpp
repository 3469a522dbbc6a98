#include "shading/even_openings.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "base/sampling.shared.h"
#include "shading/opening_squares.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace relamp
{
namespace
{

// Numerics.
constexpr float kLeastArea = 0.01f; // of a scan's surface; what comes by a smaller hole is little
constexpr size_t kFewestLooks = 8;  // at an opening, from a place
constexpr size_t kMostLooks = 32;
constexpr size_t kTogether = 16;     // that Embree traces
constexpr size_t kLooks = 8'000'000; // of a scan, for time: about as many as its lists have rays
constexpr float kTooNear = 4.0f;     // areas that a look stands for: squared distance
constexpr uint32_t kParts = 2;       // behind an upright opening

struct Opening
{
    uint32_t part; // what lies above the horizon; the next below
    std::vector<uint32_t> squares;
};

/// What a place sees of the two parts behind an opening, as shares of all it sees.
struct SeenOpening
{
    std::array<float, 2> share{};
    float variance = 0.0f;
};

/// Rays from a place to points all over an opening.
class Looks
{
public:
    Looks(const OpeningSquares& squares, std::span<const uint32_t> ofOpening,
          const SurfelSites& sites, const RayScene& scene, uint32_t surfel)
        : squares_(squares), ofOpening_(ofOpening), sites_(sites), scene_(scene), surfel_(surfel),
          shift_(seededShift(sites.seed(), surfel, 5), seededShift(sites.seed(), surfel, 6))
    {}

    /// Casts more rays, at most kTogether. False where the opening is nearer than so few points
    /// allow.
    bool cast(size_t more);
    /// Whether all that could be seen so far is seen, or nothing.
    [[nodiscard]] bool agree() const { return seenCount_ == 0 || seenCount_ == facing_; }
    [[nodiscard]] bool seeNothing() const { return seenCount_ == 0; }
    [[nodiscard]] SeenOpening seen() const;

private:
    const OpeningSquares& squares_;
    std::span<const uint32_t> ofOpening_;
    const SurfelSites& sites_;
    const RayScene& scene_;
    uint32_t surfel_;
    glm::vec2 shift_;
    size_t count_ = 0;
    size_t facing_ = 0;
    size_t seenCount_ = 0;
    std::array<float, 2> sum_{}; // of shares, were there one ray
    float squaresSum_ = 0.0f;
};

bool Looks::cast(size_t more)
{
    const size_t end = count_ + more;
    Ray rays[kTogether];
    float shares[kTogether];
    size_t count = 0;
    const auto whole = static_cast<float>(ofOpening_.size());
    for (size_t i = count_; i < end; ++i) {
        const glm::vec2 u = evenPoint(static_cast<float>(i), shift_);
        const float at = u.x * whole;
        const auto k = std::min(static_cast<size_t>(at), ofOpening_.size() - 1);
        const auto [point, normal, square] =
            squares_.pointOf(ofOpening_[k], {at - static_cast<float>(k), u.y});
        const TexelSite site = sites_.at(surfel_, i);
        const glm::vec3 origin = site.position + kOffSurface * site.normal;
        const glm::vec3 way = point - origin;
        const float squared = glm::dot(way, way);
        const float area = square * whole;
        if (squared * static_cast<float>(end) < kTooNear * area) return false;
        const float cosines =
            std::max(glm::dot(way, site.normal), 0.0f) * std::max(-glm::dot(way, normal), 0.0f);
        if (cosines <= 0.0f) continue;
        const float distance = std::sqrt(squared);
        shares[count] = area * cosines / (kPi * squared * squared);
        rays[count++] = {.origin = origin, .direction = way / distance, .farthest = distance};
    }
    uint8_t blocked[kTogether];
    scene_.occluded({rays, count}, {blocked, count});
    for (size_t i = 0; i < count; ++i) {
        if (blocked[i] != 0) continue;
        sum_[rays[i].direction.y < 0.0f ? 1 : 0] += shares[i];
        squaresSum_ += shares[i] * shares[i];
        ++seenCount_;
    }
    facing_ += count;
    count_ = end;
    return true;
}

SeenOpening Looks::seen() const
{
    const float perLook = 1.0f / static_cast<float>(count_);
    const float all = sum_[0] + sum_[1];
    return {{perLook * sum_[0], perLook * sum_[1]},
            perLook * perLook * (squaresSum_ - all * all * perLook)};
}

/// Gives a list `wanted` targets of a kind, of those and `others`: what is too many becomes others,
/// what lacks is taken from them, evenly.
void setCount(std::span<HitTarget> targets, HitTarget kind, size_t wanted,
              const std::vector<uint32_t>& ofKind, const std::vector<uint32_t>& others)
{
    if (others.empty()) return;
    const size_t excess = ofKind.size() - std::min(wanted, ofKind.size());
    for (size_t k = 0; k < excess; ++k)
        targets[ofKind[k * ofKind.size() / excess]] = targets[others[k * others.size() / excess]];
    const size_t lack = std::min(wanted - std::min(wanted, ofKind.size()), others.size());
    for (size_t k = 0; k < lack; ++k) targets[others[k * others.size() / lack]] = kind;
}

/// Targets of a list; fronts' lists have the surfels' numbers.
std::span<HitTarget> targetsOf(HitLists& hits, size_t list)
{
    return std::span(hits.targets)
        .subspan(hits.firstTarget[list], hits.firstTarget[list + 1] - hits.firstTarget[list]);
}

/// How many rays of each front's list should leave for a part behind an opening. What rounding
/// takes from one goes to the next, which is beside it mostly, so that means over a few are right.
std::vector<std::optional<size_t>> countsOf(std::span<const std::optional<SeenOpening>> seen,
                                            size_t part, HitLists& hits)
{
    std::vector<std::optional<size_t>> counts(seen.size());
    float left = 0.5f;
    for (size_t s = 0; s < seen.size(); ++s) {
        if (!seen[s]) continue;
        left += seen[s]->share[part] * static_cast<float>(targetsOf(hits, s).size());
        counts[s] = static_cast<size_t>(left);
        left -= std::floor(left);
    }
    return counts;
}

bool leavesBy(const Opening& opening, std::span<const HitTarget> targets)
{
    return std::ranges::any_of(targets, [&](HitTarget target) {
        return target.isNothing() && target.part() - opening.part < kParts; // earlier ones wrap
    });
}

/// What fronts see of an opening, where rays to it tell that better than how many of a list's
/// happened to leave there. Where the first see all of it or nothing, they are enough.
std::vector<std::optional<SeenOpening>>
seenByFronts(const Opening& opening, const OpeningSquares& squares, const SurfelSites& sites,
             const RayScene& scene, HitLists& hits, size_t fronts, size_t looks,
             Progress::Stage& stage)
{
    std::vector<std::optional<SeenOpening>> seen(fronts);
    forEachChunk(fronts, 64, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s) {
            Looks look(squares, opening.squares, sites, scene, static_cast<uint32_t>(s));
            const std::span<const HitTarget> targets = targetsOf(hits, s);
            bool isFar = look.cast(std::min(looks, kTogether));
            if (!look.agree() || (look.seeNothing() && leavesBy(opening, targets)))
                for (size_t i = kTogether; i < looks && isFar; i += kTogether)
                    isFar = look.cast(std::min(looks - i, kTogether));
            if (!isFar) continue;
            seen[s] = look.seen();
            const auto count = static_cast<float>(targets.size());
            const float all = std::min(seen[s]->share[0] + seen[s]->share[1], 1.0f);
            if (seen[s]->variance > all * (1.0f - all) / count) seen[s].reset();
        }
        stage.advance(end - begin);
    });
    return seen;
}

/// Of one of the parts behind an opening.
void evenPart(const Opening& opening, size_t part, std::span<const std::optional<SeenOpening>> seen,
              HitLists& hits)
{
    const std::vector<std::optional<size_t>> counts = countsOf(seen, part, hits);
    forEachChunk(counts.size(), 64, [&](size_t begin, size_t end) {
        std::vector<uint32_t> ofPart;
        std::vector<uint32_t> others; // none of this opening's
        for (size_t s = begin; s < end; ++s) {
            if (!counts[s]) continue;
            ofPart.clear();
            others.clear();
            const std::span<HitTarget> targets = targetsOf(hits, s);
            for (uint32_t i = 0; i < targets.size(); ++i) {
                const uint32_t at = // of earlier parts a large number: it wraps around
                    targets[i].isNothing() ? targets[i].part() - opening.part : kParts;
                if (at == part)
                    ofPart.push_back(i);
                else if (at >= kParts)
                    others.push_back(i);
            }
            setCount(targets, HitTarget::nothing(opening.part + static_cast<uint32_t>(part)),
                     *counts[s], ofPart, others);
        }
    });
}

} // namespace

void evenOpenings(const Texels& texels, const RayScene& scene, HitLists& hits, Progress& progress)
{
    if (hits.shareOfPart.size() == 1) return;
    const OpeningSquares squares(texels.surfels);
    const auto least = kLeastArea * static_cast<float>(texels.area);
    std::map<uint32_t, Opening> openings; // by their first part
    for (const Hole& hole : hits.holes)
        if (hole.parts == kParts && hole.area > least) openings[hole.part].part = hole.part;
    for (uint32_t square = 0; square < squares.count(); ++square) {
        const auto opening = openings.find(hits.partOfSquare[square]);
        if (opening != openings.end()) opening->second.squares.push_back(square);
    }
    const size_t fronts = texels.surfels.count();
    const size_t looks = std::clamp(kLooks / std::max<size_t>(fronts * openings.size(), 1),
                                    kFewestLooks, kMostLooks);
    const SurfelSites sites(texels);
    Progress::Stage stage(progress, "openings", openings.size() * fronts);
    for (const auto& [part, opening] : openings) {
        const auto seen = seenByFronts(opening, squares, sites, scene, hits, fronts, looks, stage);
        for (size_t p = 0; p < kParts; ++p) evenPart(opening, p, seen, hits);
    }
}

} // namespace relamp
