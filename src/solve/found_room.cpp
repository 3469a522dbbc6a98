#include "solve/found_room.h"

#include "fit/given_lamps.h"
#include "lights/fixtures.h"
#include "lights/surfel_radiance.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr size_t kRaysOfScan = 2'500'000; // more would not be seen beside the noise of a photo
constexpr size_t kFewestRays = 16;        // of a surfel
constexpr size_t kMostRays = 64;
constexpr float kNoFacing = 0.3f; // length of a mean normal below which a lamp shines all around

int raysOfSurfel(size_t surfels)
{
    return static_cast<int>(
        std::clamp(kRaysOfScan / std::max<size_t>(surfels, 1), kFewestRays, kMostRays));
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

FoundRoom findRoom(const Texels& texels, const RayScene& scene, const DelightOptions& options,
                   Progress& progress)
{
    FoundRoom room;
    room.radiance = collectRadiance(texels, progress);
    room.rays =
        options.gather.rays != 0 ? options.gather.rays : raysOfSurfel(texels.surfels.count());
    room.hits =
        castHitLists(texels, scene, room.radiance, static_cast<size_t>(room.rays), progress);
    room.found = findLamps(texels, scene, room.hits, room.radiance, options.gather, progress);
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

} // namespace relamp
