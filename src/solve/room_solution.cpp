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
    const std::vector<SurfelTrust> trust =
        reliabilityOf(varianceOf(found.hits, room.lighting), room.lit, varianceOfCamera(found));
    const std::vector<Rim> rims = rimsOf(texels.surfels, found.radiance, irradiance);
    Solution solution{.options = asked};
    solution.options.gather = found.options;
    solution.warnings = found.warnings;
    solution.closure = closure;
    solution.texels = {.shade = shadingOf(texels, room),
                       .rims = rims,
                       .tempering = found.tempering,
                       .shining = shiningOf(found),
                       .trust = trust,
                       .fill = fillOf(texels.surfels, found.radiance,
                                      tempered(found.tempering, irradiance), trust, rims,
                                      asked.albedo.darkest),
                       .linearization = found.linearization};
    solution.lights = lightsOf(found);
    solution.openings = openingsOf(found);
    prove(room.witnesses, room.lighting.irradiance, solution);
    solution.fixtureOf = fixturesOfSurfels(found);
    solution.glowing = found.glowing;
    solution.merged = solution.lights.points;
    return solution;
}

} // namespace relamp
