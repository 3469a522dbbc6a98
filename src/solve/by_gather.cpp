#include "solve/by_gather.h"

#include "albedo/gather_closure.h"
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
    solution.shade = shadingOf(texels, solved);
    if (options.albedo.fill)
        solution.fill = fillOf(texels.surfels, room.radiance, room.sides.albedo);
    solution.lights = lightsOf(room);
    solution.merged = solution.lights.points;
    return solution;
}

} // namespace relamp
