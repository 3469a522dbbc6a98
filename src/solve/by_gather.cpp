#include "solve/by_gather.h"

#include "albedo/fill.h"
#include "albedo/gather_closure.h"
#include "fit/given_lamps.h"
#include "fit/lamps.h"
#include "lights/fixtures.h"
#include "shading/gathered_light.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace relamp
{
namespace
{

/// Rays of a scan and of its places, by quality.
struct Effort
{
    size_t raysOfScan; // for bounce light, of all surfels together
    int fewestRays;    // of a surfel
    int mostRays;
    int shadowRays;
};

constexpr float kPi = 3.14159265f;
constexpr size_t kPatchesOfLamp = 32;
constexpr float kNoFacing = 0.3f; // length of a mean normal below which a lamp shines all around

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

/// Fills in what was left open.
void deriveRays(GatherOptions& options, size_t surfels)
{
    const Effort effort = effortFor(options.quality);
    const auto share = static_cast<int>(effort.raysOfScan / std::max<size_t>(surfels, 1));
    if (options.rays == 0) options.rays = std::clamp(share, effort.fewestRays, effort.mostRays);
    if (options.shadowRays == 0) options.shadowRays = effort.shadowRays;
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

std::shared_ptr<GatheredLight> lightOf(const Texels& texels, const RayScene& scene,
                                       const FoundLamps& found, std::vector<glm::vec3> indirect,
                                       const GatherOptions& options)
{
    std::vector<AreaLight> areas;
    std::vector<LitLamp> lamps;
    std::vector<std::vector<AreaSample>> coarse;
    for (const FoundLamp& lamp : found.lamps) {
        areas.emplace_back(lamp.patches);
        lamps.push_back({LampPatches(areas.back(), kPatchesOfLamp), lamp.radiance});
        coarse.push_back(lamp.onSides);
    }
    Visibility visibility(texels, scene, areas, coarse,
                          {.raysPerProbe = static_cast<size_t>(options.shadowRays)});
    return std::make_shared<GatheredLight>(
        GatheredLight{std::move(lamps), std::move(visibility), std::move(indirect)});
}

/// Surfels that are mostly burnt out do not know their own albedo.
std::vector<glm::vec3> fillOf(const Surfels& surfels, const SurfelRadiance& radiance,
                              const LitSides& sides)
{
    std::vector<uint8_t> isKnown(surfels.count());
    for (size_t s = 0; s < isKnown.size(); ++s)
        isKnown[s] = radiance.plainArea[s] > radiance.clippedArea[s] ? 1 : 0;
    return fillFromAround(surfels, sides.albedo, isKnown);
}

} // namespace

Solution solveByGather(const Texels& texels, const RayScene& scene, const DelightOptions& options,
                       Progress& progress)
{
    Solution solution{.options = options};
    GatherOptions& gather = solution.options.gather;
    deriveRays(gather, texels.surfels.count());
    const SurfelRadiance radiance = collectRadiance(texels, progress);
    const HitLists hits =
        castHitLists(texels, scene, radiance, static_cast<size_t>(gather.rays), progress);
    FoundLamps found = findLamps(texels, scene, hits, radiance, gather, progress);
    solution.warnings = found.warnings;
    if (options.lights) found = asGiven(*options.lights, found);
    if (found.lamps.empty())
        solution.warnings.emplace_back("no lamp was found; the room is taken to be lit from "
                                       "outside alone. Point at one with --light or --lights");

    const Progress::Stage stage(progress, "shadows");
    solution.shining = {shinesOf(found, texels.surfels.count()), 0.0f};
    const LitSides sides = lightSides(texels, hits, radiance, directOf(texels, scene, hits, found),
                                      solution.shining.surfels, found.ambient);
    solution.closure = closeLoop(hits, radiance, sides, found.ambient);
    solution.shade = shadingOf(
        texels, lightOf(texels, scene, found,
                        indirectOfFronts(texels.surfels, hits, sides, found.ambient), gather));
    if (options.albedo.fill) solution.fill = fillOf(texels.surfels, radiance, sides);
    solution.lights = lightsOf(found);
    solution.merged = solution.lights.points;
    return solution;
}

} // namespace relamp
