#pragma once

#include "relamp/progress.h"
#include "scan/rays.h"
#include "scan/texels.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Marks the texels that something stands on or lies on: every ray from them meets a surface from
/// behind, as inside a solid. A modelled room has many, a scanned one hardly any.
///
/// Where a rug lies on a floor both are one surfel; without this each would send the mean of light
/// and darkness. Returns Texels::buried; nothing
/// where most are, for then the scan is inside out.
std::vector<std::vector<uint8_t>> findBuried(const Texels& texels, const RayScene& scene,
                                             Progress& progress);

/// Surfels all of whose texels are buried: not 0.
std::vector<uint8_t> buriedSurfels(const Texels& texels);

/// Irradiance of surfels as what lies between them may be interpolated: nothing arrives under a
/// wardrobe, and what is beside it must not hear of that, so buried surfels get the mean of the
/// open ones around.
std::vector<glm::vec3> withoutBuried(const Surfels& surfels, std::span<const glm::vec3> irradiance,
                                     std::span<const uint8_t> isBuried);

} // namespace relamp
