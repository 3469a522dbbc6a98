#include "solve/by_gather.h"

#include "albedo/gather_closure.h"
#include "fit/lamp_groups.h"
#include "fit/shade.h"
#include "fit/stray.h"
#include "shading/buried.h"
#include "shading/gathered_light.h"
#include "solve/found_room.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <tbb/parallel_invoke.h>

namespace relamp
{
namespace
{

constexpr size_t kPatchesOfLamp = 32;
constexpr size_t kPatchesInGroup = 8; // of each of its lamps, at least

std::shared_ptr<GatheredLight> lightOf(const Texels& texels, const RayScene& scene,
                                       const FoundRoom& room, std::vector<glm::vec3> indirect)
{
    std::vector<LitLamp> lamps;
    const auto rays = static_cast<size_t>(room.options.shadowRays);
    Visibility visibility(texels, scene, {}, {}, {});
    for (const FoundLamp& lamp : room.found.lamps) {
        const AreaLight area(lamp.patches);
        const size_t singles = singlesOf(lamp).size();
        const size_t patches = std::max(kPatchesOfLamp, kPatchesInGroup * singles);
        lamps.push_back({LampPatches(area, patches), lamp.radiance});
        visibility.add(scene, area, lamp.onSides, rays * raysToGroup(singles));
    }
    if (const auto& sun = room.sun) {
        lamps.push_back({LampPatches(sun->disc, kPatchesOfLamp), sunRadiance(sun->sun)});
        visibility.add(*sun->outside, sun->disc, sun->onSides, rays);
    }
    return std::make_shared<GatheredLight>(
        GatheredLight{std::move(lamps), std::move(visibility), std::move(indirect)});
}

} // namespace

Solution solveByGather(const Texels& texels, const RayScene& scene, const DelightOptions& options,
                       Progress& progress)
{
    Solution solution{.options = options};
    FoundRoom room = findRoom(texels, scene, options, progress);
    solution.warnings = room.warnings;
    solution.options.gather = room.options;
    solution.shining = shiningOf(room);

    const Progress::Stage stage(progress, "shadows");
    const LitSides& sides = room.sides;
    const glm::vec3 ambient = room.found.ambient;
    const std::vector<glm::vec3> indirect =
        indirectOfFronts(texels.surfels, room.hits, sides, ambient);
    const auto light = lightOf(texels, scene, room, indirect);
    const TexelShading shade = shadingOf(texels, light);
    const StrayLight stray = fitStray(texels, room.radiance, shade);
    const SurfelLighting lighting = lightOnSurfels(texels.surfels, *light);
    std::vector<glm::vec3> irradiance = withoutStray(lighting.irradiance, stray);
    std::vector<float> lit;
    tbb::parallel_invoke( // one thread finds shade, the others what does not ask for it
        [&] { lit = findShade(texels.surfels, room.radiance, irradiance); },
        [&] {
            solution.closure = closeLoop(room.hits, room.radiance, sides, ambient);
            solution.trust = trustByView(room.hits, texels.surfels.count());
            doubtEdges(texels.surfels, room.radiance, lighting, solution.trust);
        });
    for (size_t s = 0; s < lit.size(); ++s) irradiance[s] *= lit[s];
    solution.shade = withRims(texels, withShade(texels, withoutStray(shade, stray), std::move(lit)),
                              room.radiance, irradiance);
    if (options.albedo.fill) solution.fill = fillOf(texels.surfels, room.radiance, sides.albedo);
    solution.lights = lightsOf(room);
    solution.merged = solution.lights.points;
    return solution;
}

} // namespace relamp
