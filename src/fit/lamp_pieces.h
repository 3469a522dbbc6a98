#pragma once

#include "fit/pieces.h"
#include "lights/surfel_radiance.h"
#include "relamp/gather.h"
#include "scan/rays.h"
#include "scan/texels.h"
#include "shading/hit_lists.h"

#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// All that may emit in a scan.
struct LampPieces
{
    std::vector<Piece> pieces;
    std::vector<glm::vec3> nothingNear; // see FoundLamps
    std::vector<std::string> warnings;
};

/// What is burnt out, alike neighbours as one where there are too many; their far sides, and
/// openings. What a person says of a place in `options` is not doubted. `rooms` >= 1: how many
/// there are, as roomsOf().
LampPieces lampPiecesOf(const Texels& texels, const RayScene& scene, const HitLists& hits,
                        const SurfelRadiance& radiance, const GatherOptions& options, double rooms);

} // namespace relamp
