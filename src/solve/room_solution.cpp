#include "solve/room_solution.h"

#include "albedo/gather_closure.h"
#include "albedo/paint_prior.h"
#include "fit/light_correction.h"
#include "fit/reliability.h"
#include "solve/found_lights.h"
#include "solve/proof.h"

#include <utility>

namespace relamp
{

Closure closureOf(const SolvedRoom& room)
{
    return closeLoop(room.found.hits, room.found.radiance, room.found.sides);
}

Solution solutionOf(const Texels& texels, ShadedRoom room, const DelightOptions& asked,
                    const Closure& closure)
{
    const FoundRoom& found = room.found;
    const std::vector<LightVariance> variance = varianceOf(found.hits, room.lighting);
    // A camera errs alike on all of one paint, and what is around says nothing of that.
    const std::vector<float> doubt = varianceLeft(variance, room.lit);
    const std::vector<glm::vec3> irradiance =
        tempered(found.tempering, corrected(room.lighting.irradiance, room.lit));
    Solution solution{.options = asked};
    solution.options.gather = found.options;
    solution.warnings = found.warnings;
    solution.closure = closure;
    solution.texels = {.shade = std::move(room.shade),
                       .rims = room.rims,
                       .tempering = found.tempering,
                       .shining = shiningOf(found),
                       .trust = reliabilityOf(variance, room.lit, varianceOfCamera(found)),
                       .fill = paintUnder({texels.surfels, found.radiance, irradiance, room.rims},
                                          doubt, asked.albedo.darkest),
                       .doubt = doubt,
                       .linearization = found.linearization};
    solution.lights = lightsOf(found);
    solution.openings = openingsOf(found);
    prove(room.witnesses, room.lighting.irradiance, solution);
    solution.lit = std::move(room.lit);
    solution.fixtureOf = fixturesOfSurfels(found);
    solution.glowing = found.glowing;
    solution.merged = solution.lights.points;
    return solution;
}

Solution solutionOf(const Texels& texels, const SolvedRoom& room, const DelightOptions& asked,
                    const Closure& closure)
{
    return solutionOf(texels,
                      {.found = room.found,
                       .witnesses = room.witnesses,
                       .lighting = room.lighting,
                       .shade = shadingOf(texels, room),
                       .lit = room.lit,
                       .rims = rimsOf(texels.surfels, room.found.radiance, irradianceOf(room))},
                      asked, closure);
}

} // namespace relamp
