#include "fit/pieces.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "fit/lamp_groups.h"
#include "scan/one_room.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace relamp
{
namespace
{

constexpr float kSliver = 0.02f; // ratio of areas; too small beside a lamp to be one of its own

/// Whether they touch in one plane, as panes of one window do.
bool areInOnePlane(const Candidate& a, const Candidate& b)
{
    return glm::dot(a.normal, b.normal) > kSameFacing &&
           std::abs(glm::dot(b.centre - a.centre, a.normal)) < kScanError && areTouching(a, b);
}

/// Parts of a pane may be as unequal as their errors allow: what each does, its neighbour does.
bool areOneLamp(const Piece& a, const Piece& b)
{
    if (!a.ends.empty() || !b.ends.empty()) return false;
    if (a.body == b.body) return true;
    const float errors = areInOnePlane(a.candidate, b.candidate) ? a.error + b.error : 0.0f;
    const float step = std::log(luminance(a.radiance) / luminance(b.radiance));
    const bool areEqual = std::abs(step) < std::log(kAboutEqual) + errors;
    const auto [less, more] = std::minmax(a.candidate.area, b.candidate.area);
    return (areEqual || less < kSliver * more) && areTouching(a.candidate, b.candidate);
}

void add(const Piece& piece, Piece& whole)
{
    whole.isGiven |= piece.isGiven;
    whole.isFading &= piece.isFading;
    std::vector<ClippedPatch> patches = std::move(whole.candidate.patches);
    patches.insert(patches.end(), piece.candidate.patches.begin(), piece.candidate.patches.end());
    whole.candidate = candidateOf(std::move(patches));
    whole.direct.add(piece.direct);
}

/// Whether two are burnt out all around, and of one size: globes of one model. A wall is burnt out
/// on one side.
bool areAlikeBodies(const Candidate& a, const Candidate& b)
{
    return std::max(glm::length(a.normal), glm::length(b.normal)) < kNoFacing && areOfOneSize(a, b);
}

/// Lamps of one model are of one colour: both are burnt out in all channels, or neither is.
bool areOneModel(const Piece& a, const Piece& b)
{
    const Candidate& p = a.candidate;
    const Candidate& q = b.candidate;
    return std::min(p.area, q.area) >= kCrumb && (areAlike(p, q) || areAlikeBodies(p, q)) &&
           (colouredShare(p) > 0.5f) == (colouredShare(q) > 0.5f);
}

/// Whether most parts of one are in a room with most parts of the other. Through gaps of a
/// reconstruction some are that do not belong together.
bool areInOneRoom(const RayScene& scene, const Candidate& a, const Candidate& b)
{
    // Numerics.
    constexpr size_t kParts = 4;                  // of each, evenly
    constexpr size_t kHalf = kParts * kParts / 2; // of all looks

    const auto part = [](const Candidate& of, size_t k) {
        const ClippedPatch& patch = of.patches[k * of.patches.size() / kParts];
        return FacingPlace{patch.position, patch.normal};
    };
    size_t together = 0;
    size_t apart = 0;
    for (size_t k = 0; k < kParts * kParts && together <= kHalf && apart < kHalf; ++k)
        (areInOneRoom(scene, part(a, k / kParts), part(b, k % kParts)) ? together : apart) += 1;
    return together > kHalf;
}

/// What two pieces are to each other.
struct Kin
{
    uint32_t a;
    uint32_t b;
    bool areOneBody;
    bool isModel;
    bool lean;
};

/// What piece `a` is to those behind it, where it is anything.
std::vector<Kin> kinBehind(const std::vector<Piece>& pieces, uint32_t a, const RayScene& scene)
{
    std::vector<Kin> kin;
    for (uint32_t b = a + 1; b < pieces.size(); ++b) {
        const Candidate& p = pieces[a].candidate;
        const Candidate& q = pieces[b].candidate;
        if (pieces[a].isOpening || pieces[b].isOpening) {
            if (pieces[a].isOpening == pieces[b].isOpening && areTouching(p, q))
                kin.push_back({a, b, false, true, false});
            continue;
        }
        const bool areOneBody = pieces[a].body == pieces[b].body;
        const bool lean = areOneBody || areInOnePlane(p, q);
        const bool areSeen = !areOneBody && !pieces[a].isUnseen && !pieces[b].isUnseen;
        const bool isModel =
            areSeen && areOneModel(pieces[a], pieces[b]) && areInOneRoom(scene, p, q);
        if (lean || isModel) kin.push_back({a, b, areOneBody, isModel, lean});
    }
    return kin;
}

} // namespace

size_t Piece::rays() const
{
    return raysToGroup(std::max<size_t>(ends.size(), 1));
}

/// Pieces come by falling area, a far side right behind its near one.
Kinship kinshipOf(const std::vector<Piece>& pieces, const RayScene& scene)
{
    Kinship kin{.model = std::vector<std::vector<uint32_t>>(pieces.size()),
                .leansOn = std::vector<std::vector<uint32_t>>(pieces.size())};
    std::vector<std::vector<Kin>> all(pieces.size());
    forEach(pieces.size(),
            [&](size_t a) { all[a] = kinBehind(pieces, static_cast<uint32_t>(a), scene); });
    for (const std::vector<Kin>& ofPiece : all)
        for (const auto& [a, b, areOneBody, isModel, lean] : ofPiece) {
            if (!pieces[a].isOpening && (areOneBody || isModel)) kin.alike.push_back({a, b});
            if (lean && pieces[a].candidate.area >= pieces[b].candidate.area)
                kin.leansOn[b].push_back(a);
            else if (lean)
                kin.leansOn[a].push_back(b);
            if (!isModel || lean) continue;
            kin.model[a].push_back(b);
            kin.model[b].push_back(a);
        }
    return kin;
}

void joinPieces(std::vector<Piece>& pieces)
{
    DisjointSets sets(pieces.size());
    for (uint32_t a = 0; a < pieces.size(); ++a)
        for (uint32_t b = a + 1; b < pieces.size(); ++b)
            if (areOneLamp(pieces[a], pieces[b])) sets.join(a, b);
    std::map<uint32_t, Piece> joined;
    for (uint32_t f = 0; f < pieces.size(); ++f) {
        const auto [whole, isNew] = joined.try_emplace(sets.find(f), pieces[f]);
        if (!isNew) add(pieces[f], whole->second);
    }
    pieces.clear();
    for (auto& [root, piece] : joined) pieces.push_back(std::move(piece));
}

} // namespace relamp
