#pragma once

#include "solve/cross_validation.h"
#include "solve/found_room.h"
#include "solve/solution.h"

#include <span>

#include <glm/vec3.hpp>

namespace relamp
{

/// The places that a room's light was fitted to, or would have been.
Witnesses witnessesOf(const Texels& texels, const FoundRoom& room);

/// How far the light of a room is believed that brings `irradiance` to its surfels: lights that a
/// person gives all the way, others as temperingFor() has it. Where the scan itself stands, the
/// room has no camera from now on.
Tempering provenIn(const Texels& texels, const Witnesses& witnesses,
                   std::span<const glm::vec3> irradiance, FoundRoom& room);

/// Sets the tempering of a solution and its figures. Where its shading is not believed or albedo is
/// no better than the scan, warns and lowers the trust in all surfels, which is there already.
void prove(const Witnesses& witnesses, std::span<const glm::vec3> irradiance,
           const Tempering& tempering, Solution& solution);

} // namespace relamp
