#include "solve/room_solution.h"

#include "albedo/doubts.h"
#include "albedo/gather_closure.h"
#include "shading/lit_sides.h"
#include "solve/found_room.h"
#include "solve/proof.h"

#include <utility>

namespace relamp
{
Rating rate(const Texels& texels, const SolvedRoom& room)
{
    const FoundRoom& found = room.found;
    Rating rating{closeLoop(found.hits, found.radiance, found.sides),
                  trustByView(found.hits, texels.surfels.count())};
    doubtEdges(texels.surfels, found.radiance, room.lighting, rating.trust);
    return rating;
}

Solution solutionOf(const Texels& texels, const SolvedRoom& room, const DelightOptions& asked,
                    Rating rating)
{
    const FoundRoom& found = room.found;
    const std::vector<glm::vec3> irradiance = irradianceOf(room);
    doubtCorrections(room.lit, rating.trust);
    Solution solution{.options = asked};
    solution.options.gather = found.options;
    solution.warnings = found.warnings;
    solution.closure = rating.closure;
    solution.texels = {
        .shade = shadingOf(texels, room),
        .rims = rimsOf(texels.surfels, found.radiance, irradiance),
        .tempering = found.tempering,
        .shining = shiningOf(found),
        .trust = std::move(rating.trust),
        .fill = fillOf(texels.surfels, found.radiance,
                       albedoOf(texels, found.radiance, tempered(found.tempering, irradiance))),
        .linearization = found.linearization};
    solution.lights = lightsOf(found);
    solution.openings = openingsOf(found);
    prove(room.witnesses, room.lighting.irradiance, solution);
    solution.fixtureOf = fixturesOfSurfels(found);
    solution.merged = solution.lights.points;
    return solution;
}

} // namespace relamp
