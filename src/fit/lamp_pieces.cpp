#include "fit/lamp_pieces.h"

#include "fit/lamp_groups.h"
#include "lights/candidates.h"
#include "lights/lamp_body.h"

#include <cstddef>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

namespace relamp
{
namespace
{

// Numerics.
constexpr double kMostPieces =
    96.0; // of a room, that may emit; a fit takes the square of their number

/// What is burnt out, and which of it a person calls a lamp.
struct Sought
{
    std::vector<Candidate> candidates;
    std::vector<uint8_t> isGiven;
    std::vector<glm::vec3> nothingNear;
};

Sought soughtBy(const GatherOptions& options, std::vector<Candidate> candidates)
{
    Sought sought;
    std::vector<uint8_t> isGiven(candidates.size() + 1, 0);
    std::vector<uint8_t> isRefused(candidates.size() + 1, 0);
    const auto mark = [&](glm::vec3 place, std::vector<uint8_t>& marks) {
        const size_t nearest = nearestTo(candidates, place);
        marks[nearest] = 1;
        if (nearest == candidates.size()) sought.nothingNear.push_back(place);
    };
    for (const glm::vec3 place : options.lights) mark(place, isGiven);
    for (const glm::vec3 place : options.notLights) mark(place, isRefused);
    for (size_t c = 0; c < candidates.size(); ++c) {
        if (isRefused[c] != 0) continue;
        sought.candidates.push_back(std::move(candidates[c]));
        sought.isGiven.push_back(isGiven[c]);
    }
    return sought;
}

/// A group is flat and so has no far side.
void addPieces(LampGroup group, const Texels& texels, const RayScene& scene,
               const SurfelRadiance& radiance, std::vector<Piece>& pieces)
{
    const size_t body = pieces.size();
    const bool isFading = fades(texels, radiance, group.whole);
    Piece piece{.candidate = std::move(group.whole),
                .ends = std::move(group.ends),
                .isGiven = group.isGiven,
                .body = body,
                .isFading = isFading};
    Candidate unseen;
    if (piece.ends.empty()) unseen = unseenSideOf(piece.candidate, texels, scene);
    pieces.push_back(std::move(piece));
    if (unseen.patches.empty()) return;
    pieces.push_back({.candidate = std::move(unseen), .body = body, .isUnseen = true});
}

} // namespace

LampPieces lampPiecesOf(const Texels& texels, const RayScene& scene, const HitLists& hits,
                        const SurfelRadiance& radiance, const GatherOptions& options, double rooms)
{
    Sought sought = soughtBy(options, findCandidates(texels, radiance));
    LampPieces found{.nothingNear = std::move(sought.nothingNear)};
    const auto most = static_cast<size_t>(kMostPieces * rooms);
    LampGroups lamps = groupLamps(std::move(sought.candidates), sought.isGiven, most);
    if (lamps.leftOut > 0)
        found.warnings.push_back(fmt::format("{} burnt-out pieces, {:.2f} m^2 together, are more "
                                             "than the {} largest and were taken for no lights; "
                                             "point at those that are with --light",
                                             lamps.leftOut, lamps.areaLeftOut, most));
    for (LampGroup& group : lamps.groups)
        addPieces(std::move(group), texels, scene, radiance, found.pieces);
    for (const Candidate& square : hits.squares) {
        const size_t body = found.pieces.size();
        found.pieces.push_back({.candidate = square, .body = body, .isOpening = true});
    }
    return found;
}

} // namespace relamp
