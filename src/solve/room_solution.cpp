#include "solve/room_solution.h"

#include "albedo/gather_closure.h"
#include "shading/lit_sides.h"
#include "solve/found_room.h"
#include "solve/proof.h"

#include <utility>

namespace relamp
{
Closure closureOf(const SolvedRoom& room)
{
    return closeLoop(room.found.hits, room.found.radiance, room.found.sides);
}

Solution solutionOf(const Texels& texels, const SolvedRoom& room, const DelightOptions& asked,
                    const Closure& closure)
{
    const FoundRoom& found = room.found;
    const std::vector<glm::vec3> irradiance = irradianceOf(room);
    const std::vector<LightVariance> variance = varianceOf(found.hits, room.lighting);
    // A camera errs alike on all of one paint, and what is around says nothing of that.
    const std::vector<float> doubt = varianceLeft(variance, room.lit);
    const std::vector<Rim> rims = rimsOf(texels.surfels, found.radiance, irradiance);
    Solution solution{.options = asked};
    solution.options.gather = found.options;
    solution.warnings = found.warnings;
    solution.closure = closure;
    solution.texels = {.shade = shadingOf(texels, room),
                       .rims = rims,
                       .tempering = found.tempering,
                       .shining = shiningOf(found),
                       .trust = reliabilityOf(variance, room.lit, varianceOfCamera(found)),
                       .fill = fillOf(texels.surfels, found.radiance,
                                      tempered(found.tempering, irradiance), doubt, rims,
                                      asked.albedo.darkest),
                       .doubt = doubt,
                       .linearization = found.linearization};
    solution.lights = lightsOf(found);
    solution.openings = openingsOf(found);
    prove(room.witnesses, room.lighting.irradiance, solution);
    solution.lit = room.lit;
    solution.fixtureOf = fixturesOfSurfels(found);
    solution.glowing = found.glowing;
    solution.merged = solution.lights.points;
    return solution;
}

} // namespace relamp
