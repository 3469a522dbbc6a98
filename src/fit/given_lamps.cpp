#include "fit/given_lamps.h"

#include "base/radiometry.shared.h"
#include "lights/fixture_place.h"
#include "lights/lamp_body.h"
#include "lights/shining.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

// Numerics.
constexpr float kLeastRadius = 0.02f; // m, of something without a size
constexpr float kNoLarger = 1.02f;    // ratio of areas: they are rounded, and measured again

/// The scan as far as the far side of a lamp depends on it.
struct Surroundings
{
    const Texels& texels;
    const RayScene& scene;
};

Candidate joined(const Candidate& piece, std::span<const ClippedPatch> more)
{
    std::vector<ClippedPatch> patches = piece.patches;
    patches.insert(patches.end(), more.begin(), more.end());
    return candidateOf(std::move(patches));
}

/// With its far side, mirrored.
Candidate wholeBody(const Candidate& seen, const Surroundings& room)
{
    return joined(seen, unseenSideOf(seen, room.texels, room.scene).patches);
}

/// Pieces that fixtures without a number may be: those with one first, then what is burnt out.
class PlacesOfPieces
{
public:
    PlacesOfPieces(const KnownSurfaces& known, const std::set<int>& named)
    {
        for (const auto& [number, patches] : known.byNumber)
            if (!named.contains(number)) add(candidateOf(patches));
        if (known.burntOut)
            for (Candidate& piece : known.burntOut()) add(std::move(piece));
    }

    /// The surface that a fixture stands at; none where it stands at none. A lamp may be several
    /// pieces that touch, and have a far side that was not scanned: as much of both as gives its
    /// area.
    [[nodiscard]] std::vector<ClippedPatch> at(const Fixture& fixture,
                                               const Surroundings& room) const
    {
        const size_t one = pieceAt(fixture, places_);
        Candidate seen = one < pieces_.size() ? pieces_[one] : Candidate{};
        const float most = kNoLarger * (fixture.area - fixture.unseen);
        for (const size_t p : byNearness(fixture.centre)) {
            if (p == one || seen.area + pieces_[p].area > most) continue;
            const bool belongs =
                seen.patches.empty()
                    ? glm::distance(pieces_[p].centre, fixture.centre) < std::sqrt(fixture.area)
                    : areTouching(seen, pieces_[p]);
            if (belongs) seen = joined(seen, pieces_[p].patches);
        }
        const PieceOfSurface place = pieceOf(seen);
        if (seen.patches.empty() || pieceAt(fixture, {&place, 1}) > 0) return {};
        const Candidate whole = wholeBody(seen, room);
        const bool isSeenAlone =
            std::abs(seen.area - fixture.area) < std::abs(whole.area - fixture.area);
        return (isSeenAlone ? seen : whole).patches;
    }

private:
    [[nodiscard]] std::vector<size_t> byNearness(glm::vec3 place) const
    {
        std::vector<size_t> order(pieces_.size());
        std::iota(order.begin(), order.end(), size_t{0});
        std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
            return glm::distance(pieces_[a].centre, place) <
                   glm::distance(pieces_[b].centre, place);
        });
        return order;
    }
    void add(Candidate piece)
    {
        places_.push_back(pieceOf(piece));
        pieces_.push_back(std::move(piece));
    }

    std::vector<PieceOfSurface> places_;
    std::vector<Candidate> pieces_;
};

/// How fixtures were found that their numbers do not tell.
struct Strays
{
    size_t withoutNumber = 0;
    size_t ofUnknownNumber = 0;
    size_t burntOut = 0; // of both: stand at a burnt-out piece

    void tell(bool isAnyNumberKnown, std::vector<std::string>& notes) const
    {
        const size_t bodies = withoutNumber + ofUnknownNumber - burntOut;
        const std::string how =
            fmt::format("{} by what is burnt out at their places, {} as a disc or "
                        "ball",
                        burntOut, bodies);
        if (withoutNumber > 0)
            notes.push_back(fmt::format("{} of the lights file's fixtures have no \"id\" (relamp "
                                        "0.1 wrote none), so they are known by their places: {}",
                                        withoutNumber, how));
        else if (ofUnknownNumber > 0 && !isAnyNumberKnown)
            notes.push_back(
                fmt::format("no fixtures.png beside the lights file tells the surfaces of {} of "
                            "its fixtures, so they are known by their places: {}. Put the file "
                            "into the folder of the result that it was made from",
                            ofUnknownNumber, how));
    }
};

std::string movedNote(const Fixture& fixture)
{
    return fmt::format("fixture {} was moved away from its burnt-out surface and shines from a {} "
                       "where it is now",
                       fixture.id, fixture.normal == glm::vec3(0.0f) ? "ball" : "disc");
}

void add(FoundLamp lamp, glm::vec3 radiance, FoundLamps& lamps)
{
    lamps.lamps.push_back(std::move(lamp));
    lamps.powers.lamps.push_back(radiance);
}

/// Adds a lamp to those of its group that have its radiance.
void addToGroup(FoundLamp lamp, FoundLamp& group)
{
    if (group.ends.empty()) group.ends.push_back(static_cast<uint32_t>(group.patches.size()));
    group.patches.insert(group.patches.end(), lamp.patches.begin(), lamp.patches.end());
    group.ends.push_back(static_cast<uint32_t>(group.patches.size()));
    group.labels.push_back(std::move(lamp.labels.front()));
}

} // namespace

std::vector<ClippedPatch> bodyOf(const Fixture& fixture)
{
    const bool isBall = fixture.normal == glm::vec3(0.0f);
    const float radius =
        std::max(std::sqrt(fixture.area / (isBall ? 4.0f * kPi : kPi)), kLeastRadius);
    return isBall ? patchedBall(fixture.centre, radius)
                  : patchedDisc(fixture.centre, fixture.normal, radius);
}

std::vector<std::vector<ClippedPatch>> surfacesOf(std::span<const Fixture> fixtures,
                                                  const KnownSurfaces& known, const Texels& texels,
                                                  const RayScene& scene,
                                                  std::vector<std::string>& notes)
{
    std::set<int> named;
    for (const Fixture& fixture : fixtures) named.insert(fixture.id);
    const Surroundings room{texels, scene};
    std::optional<PlacesOfPieces> places; // that are looked at only where there is need
    Strays strays;
    std::vector<std::vector<ClippedPatch>> surfaces;
    for (const Fixture& fixture : fixtures) {
        std::vector<ClippedPatch>& surface = surfaces.emplace_back();
        const auto own = known.byNumber.find(fixture.id);
        if (own == known.byNumber.end()) {
            if (!places) places.emplace(known, named);
            surface = places->at(fixture, room);
            strays.burntOut += surface.empty() ? 0u : 1u;
            if (surface.empty()) surface = bodyOf(fixture);
            ++(fixture.id < 0 ? strays.withoutNumber : strays.ofUnknownNumber);
            continue;
        }
        const Candidate seen = candidateOf(own->second);
        const Candidate whole = fixture.unseen > 0.0f ? wholeBody(seen, room) : seen;
        const bool isElsewhere = isMoved(fixture, pieceOf(whole));
        if (isElsewhere) notes.push_back(movedNote(fixture));
        surface = isElsewhere ? bodyOf(fixture) : whole.patches;
    }
    strays.tell(!known.byNumber.empty(), notes);
    return surfaces;
}

FoundLamps asGiven(const Lights& given, std::span<const std::vector<ClippedPatch>> surfaces)
{
    FoundLamps lamps;
    lamps.powers.outside = given.ambient;
    std::map<std::tuple<int, float, float, float>, size_t> places; // of a group and radiance
    for (size_t f = 0; f < given.fixtures.size(); ++f) {
        const Fixture& fixture = given.fixtures[f];
        if (isDark(fixture.radiance)) continue;
        FoundLamp lamp{surfaces[f], fixture.error};
        lamp.labels = {{given.idOf(f), fixture.name}};
        if (fixture.group < 0) {
            add(std::move(lamp), fixture.radiance, lamps);
            continue;
        }
        const glm::vec3 light = fixture.radiance;
        const auto [place, isNew] =
            places.try_emplace({fixture.group, light.r, light.g, light.b}, lamps.lamps.size());
        if (isNew)
            add(std::move(lamp), light, lamps);
        else
            addToGroup(std::move(lamp), lamps.lamps[place->second]);
    }
    int next = 0;
    for (size_t f = 0; f < given.fixtures.size(); ++f) next = std::max(next, given.idOf(f) + 1);
    for (const PointLight& light : given.points) {
        if (light.fixture >= 0 || isDark(light.intensity)) continue;
        const float radius = std::max(light.radius, kLeastRadius);
        add({.patches = patchedBall(light.position, radius), .labels = {{next++, {}}}},
            light.intensity / (kPi * radius * radius), lamps);
    }
    return lamps;
}

} // namespace relamp
