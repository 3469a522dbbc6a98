#include "solve/find_room.h"

#include "fit/given_lamps.h"
#include "fit/glowing.h"
#include "fit/lamp_groups.h"
#include "fit/outside.h"
#include "fit/pairs.h"
#include "fit/told_lamp.h"
#include "lights/candidates.h"
#include "lights/fixture_map.h"
#include "lights/surfel_radiance.h"
#include "shading/energy_limit.h"
#include "shading/even_openings.h"
#include "shading/rooms.h"
#include "solve/found_lights.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr double kLargestSurfel = 0.04; // m; light changes within more
constexpr int kLimitRounds = 2;         // what has a limit lights other things that have one

/// Rays of a room and of its places, by quality.
struct Effort
{
    double raysOfRoom; // for bounce light, of all surfels together
    double fewestRays; // of a surfel
    double mostRays;
    int shadowRays;
};

Effort effortFor(Quality quality)
{
    switch (quality) {
    case Quality::draft:
        return {250e3, 8, 32, 2};
    case Quality::high:
        return {20e6, 64, 512, 64};
    case Quality::standard:
        break;
    }
    return {5e6, 16, 128, 16}; // more would not be seen beside the noise of a photo
}

GatherOptions withRays(GatherOptions options, size_t surfels, double rooms)
{
    const Effort effort = effortFor(options.quality);
    const double share =
        rooms * effort.raysOfRoom / static_cast<double>(std::max<size_t>(surfels, 1));
    if (options.rays == 0)
        options.rays = static_cast<int>(std::clamp(share, effort.fewestRays, effort.mostRays));
    if (options.shadowRays == 0) options.shadowRays = effort.shadowRays;
    return options;
}

/// Numbers and names for all that was found.
void label(FoundLamps& found, const Texels& texels, const CoarsePieces& coarse,
           std::span<const uint8_t> roomOfSurfel, Progress& progress)
{
    std::vector<std::vector<ClippedPatch>> surfaces;
    for (const FoundLamp& lamp : found.lamps)
        if (!lamp.isSunlit)
            for (const auto& patches : singlesOf(lamp))
                surfaces.emplace_back(patches.begin(), patches.end());
    const std::vector<FixtureLabel> labels =
        labelsOf(texels, coarse, surfaces, roomOfSurfel, progress);
    auto next = labels.begin();
    for (FoundLamp& lamp : found.lamps) {
        if (lamp.isSunlit) continue;
        const auto end = next + static_cast<std::ptrdiff_t>(singlesOf(lamp).size());
        lamp.labels.assign(next, end);
        next = end;
    }
}

HitLists cast(const Texels& texels, const RayScene& scene, const FoundRoom& room,
              Progress& progress)
{
    HitLists hits = castHitLists(texels, scene, room.radiance,
                                 static_cast<size_t>(room.options.rays), progress);
    if (room.options.quality != Quality::draft) evenOpenings(texels, scene, hits, progress);
    if (room.rooms > 1.0)
        tellRoomsApart(texels, roomsOfSurfels(texels, hits, HitTarget::kMostRooms), hits);
    return hits;
}

/// Lamps that were not looked at yet are now.
void lookAtAll(const Texels& texels, const RayScene& scene, const HitLists& hits, FoundLamps& found)
{
    for (FoundLamp& lamp : found.lamps)
        if (lamp.onSides.empty())
            lamp.onSides =
                directOfLists(texels, scene, hits,
                              {AreaLight(lamp.patches), raysToGroup(singlesOf(lamp).size())});
}

/// The sun lights what it is seen from; what the texture shows to lie in shade, it does not.
void letSunIn(const Texels& texels, FoundRoom& room)
{
    FoundSun& sun = *room.found.sun;
    sun.inShade = markShade(sun.sun, texels, room.radiance, room.sides, sun.onSides);
    room.found.powers.lamps.push_back(sunRadiance(sun.sun));
    room.sides = sidesOf(texels, room);
}

/// Lights a room by what was found.
void light(const Texels& texels, const RayScene& scene, FoundRoom& room)
{
    lookAtAll(texels, scene, room.hits, room.found);
    room.sides = sidesOf(texels, room);
    if (room.found.sun) letSunIn(texels, room);
    for (int round = 0; round < kLimitRounds; ++round) {
        room.radiance.limit = energyLimit(texels.surfels, room.hits, room.sides);
        room.sides = sidesOf(texels, room);
    }
}

/// Takes out of the radiance what the camera made of it.
void linearize(const Texels& texels, FoundRoom& room)
{
    room.linearization = linearizationOf(room.found.camera, texels.surfels, room.hits.roomOfSurfel);
    if (room.linearization.isNeutral()) return;
    room.texture = std::move(room.radiance.plain);
    PixelMarks asBefore;
    if (!room.glowing.areNone()) asBefore = std::move(room.radiance.isClipped);
    room.radiance = collectRadiance(texels, unwatched(), asBefore, &room.linearization);
}

/// Finds lamps and sun.
void searchOnce(const Texels& texels, const RayScene& scene, std::span<const Glowing> glowing,
                Progress& progress, FoundRoom& room)
{
    room.found =
        findLamps(texels, scene, room.hits, room.radiance, room.options, room.rooms, progress);
    room.warnings = room.found.warnings;
    linearize(texels, room);
    addGlowing(glowing, room.radiance, room.found);
    const Progress::Stage stage(progress, "sun");
    light(texels, scene, room);
}

/// What glows counts as burnt out from now on, with what does already.
void mark(std::span<const Glowing> glowing, const Texels& texels, FoundRoom& room)
{
    if (glowing.empty()) return;
    std::vector<float> from(texels.surfels.count(), std::numeric_limits<float>::infinity());
    for (const Glowing& piece : glowing)
        for (const uint32_t s : piece.surfels) from[s] = piece.from;
    GlowMarks marks = glowingFrom(texels, from, &room.linearization);
    room.glowing.isGlowing = withGlowing(std::move(marks.isGlowing), room.glowing);
}

/// What is marked and not burnt out is, in the texture's radiance.
void takeForBurntOut(const GlowMarks& marks, const Texels& texels, SurfelRadiance& radiance)
{
    if (!marks.areNone())
        radiance =
            collectRadiance(texels, unwatched(), withGlowing(std::move(radiance.isClipped), marks));
}

/// Lets nothing glow at a place that a person calls no light; false where nothing did.
bool refuse(glm::vec3 place, const Surfels& surfels, std::vector<Glowing>& glowing)
{
    return std::erase_if(glowing, [&](const Glowing& piece) {
               return std::any_of(piece.surfels.begin(), piece.surfels.end(), [&](uint32_t s) {
                   return glm::distance(surfels.position[s], place) < kPointedAt;
               });
           }) > 0;
}

std::string nothingNear(glm::vec3 place)
{
    return fmt::format("nothing is burnt out near {}, {}, {}: what was said of a light there was "
                       "passed over",
                       place.x, place.y, place.z);
}

std::string otherOpenings(size_t given, size_t seen)
{
    return fmt::format("the lights tell of {} parts of what lies outside and this scan has {}: it "
                       "is as bright as \"ambient\" on all sides; give lights that were found in "
                       "this scan, or take \"openings\" out of them",
                       given, seen);
}

/// Finds lamps, with those that a person `told` of, and sun; once more where something turns out to
/// glow, for then the light of the room comes from there and is better looked for than met by
/// chance.
void search(const Texels& texels, const RayScene& scene, const CoarsePieces& coarse,
            std::vector<Glowing> told, Progress& progress, FoundRoom& room)
{
    searchOnce(texels, scene, told, progress, room);
    std::vector<Glowing> glowing =
        findGlowing(texels.surfels, room.radiance, room.sides, shinesOf(room, room.found.powers));
    std::vector<glm::vec3> refused;
    for (const glm::vec3 place : room.options.notLights)
        if (refuse(place, texels.surfels, glowing)) refused.push_back(place);
    if (!glowing.empty()) {
        mark(glowing, texels, room);
        room.linearization = {};
        room.texture = {};
        room.radiance = collectRadiance(texels, unwatched());
        takeForBurntOut(room.glowing, texels, room.radiance);
        room.hits = cast(texels, scene, room, progress);
        std::ranges::move(glowing, std::back_inserter(told));
        searchOnce(texels, scene, told, progress, room);
    }
    for (const glm::vec3 place : room.found.nothingNear)
        if (std::find(refused.begin(), refused.end(), place) == refused.end())
            room.warnings.push_back(nothingNear(place));
    room.glowsFrom = leastOfGlowing(texels, room.glowing, &room.linearization);
    label(room.found, texels, coarse, room.hits.roomOfSurfel, progress);
}

/// Lights the room as a person says. Fixtures that are off are panes to the sun as well.
void take(const Lights& given, const DelightOptions& options, const Texels& texels,
          const RayScene& scene, Progress& progress, FoundRoom& room)
{
    const Progress::Stage stage(progress, "given light");
    const KnownSurfaces known{surfacesBy(options.fixtures, texels, room.radiance),
                              [&] { return findCandidates(texels, room.radiance); }};
    const std::vector<std::vector<ClippedPatch>> surfaces =
        surfacesOf(given.fixtures, known, texels, scene, room.warnings);
    room.found = asGiven(given, surfaces);
    room.isGiven = true;
    room.tempering = given.tempering;
    room.found.camera = given.camera;
    room.found.gaps = given.gaps;
    linearize(texels, room);
    room.glowsFrom = leastOfGlowing(texels, room.glowing, &room.linearization);
    if (given.openings.size() == room.hits.shareOfPart.size())
        room.found.powers.outside = {given.ambient, given.openings};
    else if (!given.openings.empty())
        room.warnings.push_back(otherOpenings(given.openings.size(), room.hits.shareOfPart.size()));
    if (given.sun) {
        FoundLamps panes;
        for (const auto& surface : surfaces) panes.lamps.push_back({.patches = surface});
        RayScene outside = sceneWithoutPanes(scene, texels, room.radiance, panes);
        const AreaLight disc(sunDisc(*given.sun, *texels.scan));
        LampSight onSides = directOfLists(texels, outside, room.hits, {disc});
        room.found.sun = {*given.sun, std::move(outside), std::move(onSides)};
    }
    light(texels, scene, room);
}

} // namespace

SurfelOptions surfelsOf(const GatherOptions& options)
{
    const bool isDraft = options.quality == Quality::draft;
    return {.texelsAcross = isDraft ? 4.0 : 2.0,
            .largest = isDraft ? 0.12 : kLargestSurfel,
            .layered = true,
            .connected = false,
            .seed = options.seed};
}

FoundRoom findRoom(const Texels& texels, const RayScene& scene, const DelightOptions& options,
                   Progress& progress, const FoundRoom* before)
{
    FoundRoom room;
    room.rooms = std::min(std::round(roomsOf(texels.surfels, scene)),
                          static_cast<double>(HitTarget::kMostRooms));
    room.options = withRays(options.gather, texels.surfels.count(), room.rooms);
    const bool isBefore = before != nullptr && before->glowing.areNone();
    room.radiance = isBefore && before->linearization.isNeutral()
                        ? before->radiance
                        : collectRadiance(texels, progress);
    room.radiance.limit.clear(); // under the light of before
    std::vector<Glowing> told;
    if (options.lights) {
        room.glowing = glowingBy(options.fixtures, room.radiance.isClipped);
    } else {
        told = toldLamps(options.gather.lights, texels.surfels, room.radiance);
        for (const glm::vec3 place : options.gather.notLights) refuse(place, texels.surfels, told);
        mark(told, texels, room);
    }
    takeForBurntOut(room.glowing, texels, room.radiance);
    const CoarsePieces coarse = options.lights ? CoarsePieces{} : coarsePiecesOf(texels, progress);
    const bool isCast = isBefore && room.glowing.areNone();
    room.hits = isCast && before->options.rays == room.options.rays
                    ? before->hits
                    : cast(texels, scene, room, progress);
    room.rooms = std::max(room.rooms, static_cast<double>(room.hits.rooms));
    if (options.lights)
        take(beforeScale(*options.lights), options, texels, scene, progress, room);
    else
        search(texels, scene, coarse, std::move(told), progress, room);
    if (room.found.lamps.empty() && !room.found.sun)
        room.warnings.emplace_back("no lamp was found; the room is taken to be lit from "
                                   "outside alone. Point at one with --light or --lights");
    return room;
}

} // namespace relamp
