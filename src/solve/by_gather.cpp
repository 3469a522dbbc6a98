#include "solve/by_gather.h"

#include "albedo/gather_closure.h"
#include "fit/stray.h"
#include "shading/buried.h"
#include "shading/lit_sides.h"
#include "solve/found_room.h"
#include "solve/resolve.h"

#include <utility>

namespace relamp
{
Solution solveByGather(const Texels& texels, const RayScene& scene, const DelightOptions& options,
                       Progress& progress)
{
    Solution solution{.options = options};
    FoundRoom found = findRoom(texels, scene, options, progress);
    solution.warnings = found.warnings;
    solution.options.gather = found.options;
    solution.shining = shiningOf(found);

    const Progress::Stage stage(progress, "shadows");
    const auto rate = [&](const SolvedRoom& solved) {
        const FoundRoom& room = solved.found;
        solution.closure = closeLoop(room.hits, room.radiance, room.sides, room.found.ambient);
        solution.trust = trustByView(room.hits, texels.surfels.count());
        doubtEdges(texels.surfels, room.radiance, solved.lighting, solution.trust);
    };
    const SolvedRoom solved = solvedRoom(texels, scene, std::move(found), rate);
    const FoundRoom& room = solved.found;
    std::vector<glm::vec3> irradiance = withoutStray(solved.lighting.irradiance, solved.stray);
    for (size_t s = 0; s < irradiance.size(); ++s) irradiance[s] *= solved.lit[s];
    solution.shade = withRims(texels, shadingOf(texels, solved), room.radiance, irradiance);
    solution.fill =
        fillOf(texels.surfels, room.radiance, albedoOf(texels, room.radiance, irradiance));
    solution.lights = lightsOf(room);
    solution.merged = solution.lights.points;
    return solution;
}

} // namespace relamp
