#pragma once

#include "solve/cross_validation.h"
#include "solve/found_room.h"
#include "solve/solution.h"

#include <span>

#include <glm/vec3.hpp>

namespace relamp
{

/// The places that a room's light was fitted to, or would have been.
Witnesses witnessesOf(const Texels& texels, const RayScene& scene, const FoundRoom& room);

/// Believes the light of a room, which brings `irradiance` to its surfels, as far as temperingFor()
/// does; lights that a person gives as far as they say. Where the scan itself stands, the room has
/// no camera from now on.
void temper(const Texels& texels, const Witnesses& witnesses, std::span<const glm::vec3> irradiance,
            FoundRoom& room);

/// Sets a solution's figures, under the tempering of its lights. Where the shading is not believed
/// or albedo is worse than the scan, warns and lowers the trust in all surfels, which is there
/// already.
void prove(const Witnesses& witnesses, std::span<const glm::vec3> irradiance, Solution& solution);

} // namespace relamp
