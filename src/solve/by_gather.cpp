#include "solve/by_gather.h"

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

constexpr size_t kRaysOfScan = 2'500'000; // more would not be seen beside the noise of a photo
constexpr size_t kFewestRays = 16;        // of a surfel
constexpr size_t kMostRays = 64;
constexpr size_t kPatchesOfLamp = 32;
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

} // namespace

Solution solveByGather(const Texels& texels, const RayScene& scene, const DelightOptions& options,
                       Progress& progress)
{
    Solution solution{.options = options};
    int& rays = solution.options.gather.rays;
    if (rays == 0) rays = raysOfSurfel(texels.surfels.count());
    const SurfelRadiance radiance = collectRadiance(texels, progress);
    const HitLists hits =
        castHitLists(texels, scene, radiance, static_cast<size_t>(rays), progress);
    FoundLamps found = findLamps(texels, scene, hits, radiance, options.gather, progress);
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
    solution.shade =
        shadingOf(texels, lightOf(texels, scene, found,
                                  indirectOfFronts(texels.surfels, hits, sides, found.ambient),
                                  options.gather));
    solution.lights = lightsOf(found);
    solution.merged = solution.lights.points;
    return solution;
}

} // namespace relamp
