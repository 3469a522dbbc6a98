#include "solve/by_gather.h"

#include "albedo/gather_closure.h"
#include "fit/stray.h"
#include "shading/buried.h"
#include "shading/gathered_light.h"
#include "solve/found_room.h"

#include <memory>
#include <utility>

namespace relamp
{
namespace
{

constexpr size_t kPatchesOfLamp = 32;

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
    FoundRoom room = findRoom(texels, scene, options, progress);
    solution.warnings = room.warnings;
    solution.options.gather = room.options;
    solution.shining = {room.shines, 0.0f};

    const Progress::Stage stage(progress, "shadows");
    const LitSides sides = litSidesOf(texels, scene, room);
    const glm::vec3 ambient = room.found.ambient;
    solution.closure = closeLoop(room.hits, room.radiance, sides, ambient);
    const std::vector<glm::vec3> indirect =
        withoutBuried(texels.surfels, indirectOfFronts(texels.surfels, room.hits, sides, ambient),
                      buriedSurfels(texels));
    const auto light = lightOf(texels, scene, room.found, indirect, room.options);
    const TexelShading shade = shadingOf(texels, light);
    solution.shade = withoutStray(shade, fitStray(texels, room.radiance, shade));
    solution.trust = trustByView(room.hits, texels.surfels.count());
    doubtEdges(texels.surfels, room.radiance, lightOnSurfels(texels.surfels, *light),
               solution.trust);
    if (options.albedo.fill) solution.fill = fillOf(texels.surfels, room.radiance, sides.albedo);
    solution.lights = lightsOf(room.found);
    solution.merged = solution.lights.points;
    return solution;
}

} // namespace relamp
