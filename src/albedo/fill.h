#pragma once

#include "scan/surfels.h"

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// An albedo for every surfel: where `isKnown` is not 0 its own, elsewhere what the surface around
/// it has, carried inwards from the rim. Surfels that no known one can be reached from get
/// `otherwise`, a grey.
std::vector<glm::vec3> fillFromAround(const Surfels& surfels, std::span<const glm::vec3> albedo,
                                      std::span<const uint8_t> isKnown, float otherwise = 0.5f);

} // namespace relamp
