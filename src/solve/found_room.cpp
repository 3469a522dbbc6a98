#include "solve/found_room.h"

#include "albedo/fill.h"
#include "fit/given_lamps.h"
#include "lights/fixtures.h"
#include "lights/surfel_radiance.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kNoFacing = 0.3f; // length of a mean normal below which a lamp shines all around

/// Rays of a scan and of its places, by quality.
struct Effort
{
    size_t raysOfScan; // for bounce light, of all surfels together
    int fewestRays;    // of a surfel
    int mostRays;
    int shadowRays;
};

Effort effortFor(Quality quality)
{
    switch (quality) {
    case Quality::draft:
        return {500'000, 8, 32, 3};
    case Quality::high:
        return {10'000'000, 64, 256, 32};
    case Quality::standard:
        break;
    }
    return {2'500'000, 16, 64, 8}; // more would not be seen beside the noise of a photo
}

GatherOptions withRays(GatherOptions options, size_t surfels)
{
    const Effort effort = effortFor(options.quality);
    const auto share = static_cast<int>(effort.raysOfScan / std::max<size_t>(surfels, 1));
    if (options.rays == 0) options.rays = std::clamp(share, effort.fewestRays, effort.mostRays);
    if (options.shadowRays == 0) options.shadowRays = effort.shadowRays;
    return options;
}

Fixture fixtureOf(const FoundLamp& lamp)
{
    Fixture fixture;
    glm::vec3 normal(0.0f);
    for (const ClippedPatch& patch : lamp.patches) {
        fixture.centre += patch.area * patch.position;
        normal += patch.area * patch.normal;
        fixture.area += patch.area;
    }
    fixture.centre /= fixture.area;
    const float length = glm::length(normal);
    if (length > kNoFacing * fixture.area) fixture.normal = normal / length;
    fixture.radiance = lamp.radiance;
    fixture.error = lamp.logError;
    fixture.determined = lamp.isDetermined;
    return fixture;
}

/// Irradiance from all lamps, one a hit list. Lamps that were not looked at yet are now.
std::vector<glm::vec3> directOf(const Texels& texels, const RayScene& scene, const HitLists& hits,
                                FoundLamps& found)
{
    std::vector<glm::vec3> direct(hits.sideOfList.size(), glm::vec3(0.0f));
    for (FoundLamp& lamp : found.lamps) {
        if (lamp.onSides.empty())
            lamp.onSides = directOfLists(texels, scene, hits, AreaLight(lamp.patches));
        addDirect(lamp.onSides, lamp.radiance, direct);
    }
    return direct;
}

} // namespace

SurfelOptions surfelsOf(Quality quality)
{
    return {.texelsAcross = quality == Quality::draft ? 4.0 : 2.0};
}

FoundRoom findRoom(const Texels& texels, const RayScene& scene, const DelightOptions& options,
                   Progress& progress)
{
    FoundRoom room;
    room.radiance = collectRadiance(texels, progress);
    room.options = withRays(options.gather, texels.surfels.count());
    room.hits = castHitLists(texels, scene, room.radiance, static_cast<size_t>(room.options.rays),
                             progress);
    room.found = findLamps(texels, scene, room.hits, room.radiance, room.options, progress);
    room.warnings = room.found.warnings;
    if (options.lights) room.found = asGiven(*options.lights, room.found);
    if (room.found.lamps.empty())
        room.warnings.emplace_back("no lamp was found; the room is taken to be lit from "
                                   "outside alone. Point at one with --light or --lights");
    room.shines = shinesOf(room.found, texels.surfels.count());
    return room;
}

LitSides litSidesOf(const Texels& texels, const RayScene& scene, FoundRoom& room)
{
    return lightSides(texels, room.hits, room.radiance,
                      directOf(texels, scene, room.hits, room.found), room.shines,
                      room.found.ambient);
}

Lights lightsOf(const FoundLamps& found)
{
    Lights lights;
    lights.ambient = found.ambient;
    for (const FoundLamp& lamp : found.lamps) {
        lights.points.push_back(
            pointLightOf(fixtureOf(lamp), static_cast<int>(lights.fixtures.size())));
        lights.fixtures.push_back(fixtureOf(lamp));
    }
    return lights;
}

std::vector<glm::vec3> fillOf(const Surfels& surfels, const SurfelRadiance& radiance,
                              std::span<const glm::vec3> albedo)
{
    std::vector<uint8_t> isKnown(surfels.count());
    for (size_t s = 0; s < isKnown.size(); ++s)
        isKnown[s] = radiance.plainArea[s] > radiance.clippedArea[s] ? 1 : 0;
    return fillFromAround(surfels, albedo, isKnown);
}

} // namespace relamp
