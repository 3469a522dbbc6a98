#include "lights/candidates.h"

#include "base/biweight.shared.h"
#include "base/disjoint_sets.h"
#include "base/radiometry.shared.h"
#include "image/burnt_out.shared.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kLargePlane = 0.5f;   // m^2; smaller ones may be parts of lamps
constexpr float kWallAround = 0.4f;   // of a square's rim that is wall
constexpr float kNearlyWhite = 0.75f; // of what burns out: what shows as much nearly did
constexpr float kFlat = 0.9f;         // length of a mean normal; more faces one way

// Numerics.
constexpr size_t kMostPlanes = 4; // of one blob

using Members = std::vector<uint32_t>; // indices into SurfelRadiance::clipped

/// Index into SurfelRadiance::clipped of each surfel; -1 where nothing is clipped.
std::vector<int32_t> clippedOfSurfel(const SurfelRadiance& radiance, size_t surfels)
{
    std::vector<int32_t> index(surfels, -1);
    for (size_t i = 0; i < radiance.clipped.size(); ++i)
        index[radiance.clipped[i].surfel] = static_cast<int32_t>(i);
    return index;
}

float areaOf(const SurfelRadiance& radiance, const Members& members)
{
    float area = 0.0f;
    for (const uint32_t i : members) area += radiance.clipped[i].area;
    return area;
}

/// A plane through the largest patch that grows to the mean of what lies on it.
struct Plane
{
    glm::vec3 normal;
    float offset;

    [[nodiscard]] bool holds(glm::vec3 position, glm::vec3 facing) const
    {
        return glm::dot(facing, normal) > kSameFacing &&
               std::abs(glm::dot(position, normal) - offset) < 1.5f * kScanError;
    }

    /// 1 in the plane, 0 beyond the error of a scan.
    [[nodiscard]] float nearness(glm::vec3 position) const
    {
        const float distance = (glm::dot(position, normal) - offset) / kScanError;
        return biweight(distance * distance);
    }
};

/// What lies on a plane. It counts more than what is near, or a plane between a panel and its
/// ceiling would hold both.
struct Held
{
    glm::vec3 normal{0.0f};   // times area
    glm::vec3 position{0.0f}; // times area
    float area = 0.0f;        // m^2
};

Held heldBy(const Plane& plane, const SurfelRadiance& radiance, const Members& members)
{
    Held held;
    for (const uint32_t i : members) {
        const ClippedPatch& patch = radiance.clipped[i];
        if (!plane.holds(patch.position, patch.normal)) continue;
        const float area = patch.area * plane.nearness(patch.position);
        held.normal += area * patch.normal;
        held.position += area * patch.position;
        held.area += area;
    }
    return held;
}

/// The plane that holds most of the members' area, of a few tried.
Plane largestPlane(const SurfelRadiance& radiance, const Members& members)
{
    const size_t tried = std::min<size_t>(24, members.size()); // from patches evenly among them
    Plane best{};
    float most = -1.0f;
    for (size_t t = 0; t < tried; ++t) {
        const ClippedPatch& seed = radiance.clipped[members[t * members.size() / tried]];
        Plane plane{seed.normal, glm::dot(seed.position, seed.normal)};
        Held held = heldBy(plane, radiance, members);
        for (int round = 0; round < 8 && held.area > 0.0f; ++round) {
            plane.normal = glm::normalize(held.normal);
            plane.offset = glm::dot(held.position / held.area, plane.normal);
            held = heldBy(plane, radiance, members);
        }
        if (held.area > most) {
            most = held.area;
            best = plane;
        }
    }
    return best;
}

/// Surfels beside a piece that are not burnt out and that `goesOn(beside, inside)`, each once.
template<class GoesOn>
std::vector<uint32_t> rimOf(const Texels& texels, const SurfelRadiance& radiance,
                            std::span<const ClippedPatch> piece, const GoesOn& goesOn)
{
    std::vector<uint32_t> rim;
    for (const ClippedPatch& patch : piece) {
        if (patch.surfel == Surfels::kNone) continue;
        for (const uint32_t other : texels.surfels.neighborsOf(patch.surfel))
            if (radiance.plainArea[other] > radiance.clippedArea[other] &&
                goesOn(other, patch.surfel))
                rim.push_back(other);
    }
    std::sort(rim.begin(), rim.end());
    rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
    return rim;
}

/// Surfels along the rim of a square of that area.
float rimOfSquare(float area, const Surfels& surfels)
{
    return 4.0f * std::sqrt(area) / surfels.size;
}

std::vector<ClippedPatch> patchesOf(const SurfelRadiance& radiance, const Members& members)
{
    std::vector<ClippedPatch> patches;
    for (const uint32_t i : members) patches.push_back(radiance.clipped[i]);
    return patches;
}

/// Whether the plane is a wall that goes on around a piece of it, not burnt out: that piece is the
/// wall beside a lamp, or a lamp let into it.
bool goesOn(const Texels& texels, const SurfelRadiance& radiance, const Members& piece,
            const Plane& plane)
{
    const Surfels& surfels = texels.surfels;
    const auto rim =
        rimOf(texels, radiance, patchesOf(radiance, piece), [&](uint32_t beside, uint32_t) {
            return plane.holds(surfels.position[beside], surfels.normal[beside]);
        });
    return static_cast<float>(rim.size()) >
           kWallAround * rimOfSquare(areaOf(radiance, piece), surfels);
}

/// Cuts the large planes out of a blob; what is left comes last.
std::vector<Members> cutPlanes(const Texels& texels, const SurfelRadiance& radiance,
                               Members members)
{
    std::vector<Members> pieces;
    while (pieces.size() < kMostPlanes && areaOf(radiance, members) > kPaneArea) {
        const Plane plane = largestPlane(radiance, members);
        Members on;
        Members off;
        for (const uint32_t i : members) {
            const ClippedPatch& patch = radiance.clipped[i];
            (plane.holds(patch.position, patch.normal) ? on : off).push_back(i);
        }
        const float area = areaOf(radiance, on);
        if (area < kPaneArea) break;
        if (area < kLargePlane && !goesOn(texels, radiance, on, plane)) break;
        pieces.push_back(std::move(on));
        members = std::move(off);
    }
    pieces.push_back(std::move(members));
    return pieces;
}

/// Connected pieces of `members`, or of all that is clipped where `part` is the same for all.
std::vector<Members> connected(const Texels& texels, const SurfelRadiance& radiance,
                               const std::vector<int32_t>& part)
{
    const std::vector<int32_t> index = clippedOfSurfel(radiance, texels.surfels.count());
    DisjointSets sets(radiance.clipped.size());
    for (uint32_t i = 0; i < radiance.clipped.size(); ++i) {
        const ClippedPatch& patch = radiance.clipped[i];
        for (const uint32_t other : texels.surfels.neighborsOf(patch.surfel)) {
            const int32_t j = index[other];
            if (j < 0 || part[static_cast<size_t>(j)] != part[i]) continue;
            if (glm::dot(patch.normal, radiance.clipped[static_cast<size_t>(j)].normal) >
                kSameFacing)
                sets.join(i, static_cast<uint32_t>(j));
        }
    }
    std::map<uint32_t, Members> blobs;
    for (uint32_t i = 0; i < radiance.clipped.size(); ++i) blobs[sets.find(i)].push_back(i);
    std::vector<Members> result;
    result.reserve(blobs.size());
    for (auto& [root, members] : blobs) result.push_back(std::move(members));
    return result;
}

/// A small flat piece in a surface that is nearly as bright all around it.
bool isSpeck(const Texels& texels, const SurfelRadiance& radiance, const Candidate& candidate)
{
    if (candidate.area > kSpeck || !isFlat(candidate)) return false;
    float sum = 0.0f;
    float area = 0.0f;
    for (const ClippedPatch& patch : candidate.patches)
        for (const uint32_t other : texels.surfels.neighborsOf(patch.surfel)) {
            sum += radiance.plainArea[other] * luminance(radiance.plain[other]);
            area += radiance.plainArea[other];
        }
    return area > 0.0f && sum > kNearlyWhite * area;
}

/// One candidate of each set of them.
std::vector<Candidate> joined(const std::vector<Candidate>& candidates, DisjointSets& sets)
{
    std::map<uint32_t, std::vector<ClippedPatch>> pieces;
    for (uint32_t c = 0; c < candidates.size(); ++c) {
        std::vector<ClippedPatch>& piece = pieces[sets.find(c)];
        piece.insert(piece.end(), candidates[c].patches.begin(), candidates[c].patches.end());
    }
    std::vector<Candidate> joined;
    joined.reserve(pieces.size());
    for (auto& [root, patches] : pieces) joined.push_back(candidateOf(std::move(patches)));
    return joined;
}

/// Whether neither rises before the other: they may be parts of one body, as a bulb's sides are,
/// where a bulb and the inside of its shade are not.
bool areOfOneBody(const ClippedPatch& a, const ClippedPatch& b)
{
    const glm::vec3 way = b.position - a.position;
    return glm::dot(a.normal, way) <= 0.0f && glm::dot(b.normal, -way) <= 0.0f;
}

/// What is small has facings as sharply apart as the sides of a box: crumbs of one body are one
/// piece, and with what else is small there, so that a bulb is one lamp and not six.
std::vector<Candidate> joinCrumbs(const Surfels& surfels, const std::vector<Candidate>& candidates)
{
    struct SmallPatch
    {
        uint32_t candidate = Surfels::kNone;
        const ClippedPatch* patch = nullptr;
    };
    std::vector<SmallPatch> small(surfels.count()); // of surfels
    for (uint32_t c = 0; c < candidates.size(); ++c)
        if (candidates[c].area < 2.0f * kCrumb)
            for (const ClippedPatch& patch : candidates[c].patches)
                small[patch.surfel] = {c, &patch};
    DisjointSets sets(candidates.size());
    for (uint32_t s = 0; s < small.size(); ++s) {
        const auto [c, patch] = small[s];
        if (c == Surfels::kNone || candidates[c].area >= kCrumb) continue;
        surfels.forEachInReach(surfels.position[s], [&, c = c, patch = patch](size_t near) {
            const SmallPatch& other = small[near];
            if (other.candidate != Surfels::kNone && surfels.areBeside(s, near) &&
                areOfOneBody(*patch, *other.patch))
                sets.join(c, other.candidate);
        });
    }
    return joined(candidates, sets);
}

/// How far one lies behind the other in the mean over their patches: the sine below its surface.
float behind(const Candidate& a, const Candidate& b)
{
    // Numerics.
    constexpr size_t kLooks = 64; // patches of each, evenly, at most

    const size_t countA = std::min(kLooks, a.patches.size());
    const size_t countB = std::min(kLooks, b.patches.size());
    float sum = 0.0f;
    for (size_t i = 0; i < countA; ++i) {
        const ClippedPatch& from = a.patches[i * a.patches.size() / countA];
        for (size_t j = 0; j < countB; ++j) {
            const glm::vec3 way = b.patches[j * b.patches.size() / countB].position - from.position;
            sum -= glm::dot(from.normal, way) / std::max(glm::length(way), 1e-6f);
        }
    }
    return sum / static_cast<float>(countA * countB);
}

/// Whether they are sides of one body, as of a box or a shade: each lies behind the other, by more
/// than half of what a part of one plane may, for of many parts that is less. What a lamp stands on
/// or hangs from lies before it, and two sides of a wall are of two rooms.
bool areSides(const Candidate& a, const Candidate& b)
{
    const float least = 0.5f * std::sqrt(1.0f - kSamePlane * kSamePlane);
    return std::min(a.area, b.area) >= kCrumb && glm::dot(a.normal, b.normal) > -kSameFacing &&
           areTouching(a, b) && std::min(behind(a, b), behind(b, a)) > least;
}

/// A shade is one lamp and not six: by itself a side that lights little is a matter of chance.
std::vector<Candidate> joinSides(const std::vector<Candidate>& candidates)
{
    DisjointSets sets(candidates.size());
    for (uint32_t a = 0; a < candidates.size(); ++a)
        for (uint32_t b = a + 1; b < candidates.size(); ++b)
            if (areSides(candidates[a], candidates[b])) sets.join(a, b);
    return joined(candidates, sets);
}

} // namespace

Candidate candidateOf(std::vector<ClippedPatch> patches)
{
    Candidate candidate{.patches = std::move(patches)};
    for (const ClippedPatch& patch : candidate.patches) {
        candidate.area += patch.area;
        candidate.centre += patch.area * patch.position;
        candidate.normal += patch.area * patch.normal;
    }
    if (candidate.area > 0.0f) {
        candidate.centre /= candidate.area;
        candidate.normal /= candidate.area;
    }
    return candidate;
}

bool isFlat(const Candidate& candidate)
{
    return glm::length(candidate.normal) >= kFlat;
}

float errorOfArea(float area)
{
    return 2.0f * std::log1p(kScanError / std::sqrt(area));
}

bool fades(const Texels& texels, const SurfelRadiance& radiance, const Candidate& candidate)
{
    const Surfels& surfels = texels.surfels;
    const auto rim =
        rimOf(texels, radiance, candidate.patches, [&](uint32_t beside, uint32_t inside) {
            const Plane plane{surfels.normal[inside],
                              glm::dot(surfels.position[inside], surfels.normal[inside])};
            return plane.holds(surfels.position[beside], surfels.normal[beside]);
        });
    if (static_cast<float>(rim.size()) < rimOfSquare(candidate.area, surfels)) return false;
    const auto nearlyBurntOut = std::count_if(rim.begin(), rim.end(), [&](uint32_t s) {
        const glm::vec3 color = radiance.plain[s];
        return std::max({color.r, color.g, color.b}) > kNearlyWhite;
    });
    return 2 * static_cast<size_t>(nearlyBurntOut) > rim.size();
}

float colouredShare(const Candidate& candidate)
{
    float area = 0.0f;
    for (const ClippedPatch& patch : candidate.patches) {
        const glm::vec3 rgb = patch.radiance;
        if (std::min({rgb.r, rgb.g, rgb.b}) < kSafelyBelow) area += patch.area;
    }
    return candidate.area > 0.0f ? area / candidate.area : 0.0f;
}

size_t nearestTo(std::span<const Candidate> candidates, glm::vec3 place)
{
    size_t nearest = candidates.size();
    float least = kPointedAt;
    for (size_t c = 0; c < candidates.size(); ++c)
        for (const ClippedPatch& patch : candidates[c].patches)
            if (const float distance = glm::distance(patch.position, place); distance < least) {
                least = distance;
                nearest = c;
            }
    return nearest;
}

Bounds boundsAround(const Candidate& candidate, float reach)
{
    Bounds bounds{glm::vec3(std::numeric_limits<float>::max()),
                  glm::vec3(std::numeric_limits<float>::lowest())};
    for (const ClippedPatch& patch : candidate.patches) {
        bounds.low = glm::min(bounds.low, patch.position - reach);
        bounds.high = glm::max(bounds.high, patch.position + reach);
    }
    return bounds;
}

bool areWithin(const Candidate& a, const Candidate& b, float reach)
{
    const Bounds around = boundsAround(a, reach);
    for (const ClippedPatch& q : b.patches) {
        if (!around.contains(q.position)) continue;
        for (const ClippedPatch& p : a.patches) {
            const glm::vec3 way = p.position - q.position;
            if (glm::dot(way, way) < reach * reach) return true;
        }
    }
    return false;
}

bool areTouching(const Candidate& a, const Candidate& b)
{
    return areWithin(a, b, kTouching);
}

std::vector<Candidate> findCandidates(const Texels& texels, const SurfelRadiance& radiance)
{
    std::vector<int32_t> part(radiance.clipped.size(), 0);
    int32_t parts = 1;
    for (const Members& blob : connected(texels, radiance, part))
        for (const Members& piece : cutPlanes(texels, radiance, blob)) {
            for (const uint32_t i : piece) part[i] = parts;
            ++parts;
        }
    std::vector<Candidate> candidates;
    for (const Members& members : connected(texels, radiance, part))
        candidates.push_back(candidateOf(patchesOf(radiance, members)));
    candidates = joinCrumbs(texels.surfels, candidates);
    std::erase_if(candidates,
                  [&](const Candidate& candidate) { return isSpeck(texels, radiance, candidate); });
    candidates = joinSides(candidates);
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.area > b.area; });
    return candidates;
}

} // namespace relamp
