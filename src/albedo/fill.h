#pragma once

#include "scan/surfels.h"

#include <span>
#include <vector>

#include <glm/ext/vector_bool3.hpp>
#include <glm/vec3.hpp>

namespace relamp
{

/// An albedo for every surfel: where `isKnown` is not 0 its own, elsewhere what the surface around
/// it has, carried inwards from the rim. Surfels that no known one can be reached from get
/// `otherwise`, a grey.
std::vector<glm::vec3> fillFromAround(const Surfels& surfels, std::span<const glm::vec3> albedo,
                                      std::span<const uint8_t> isKnown, float otherwise = 0.5f);

/// What division said of a texel.
struct Divided
{
    glm::vec3 albedo{0.0f};
    float lack = 1.0f; // see lightThatLacks()
};

/// Albedo of a texel of which channels are burnt out or unlit. What a burnt-out channel shows is
/// the least that it can be, and the less sure the more light lacks. `around`: of the surface.
/// `burntOut`: 0..1, how likely a channel is: what several photos were blended to may be in part.
glm::vec3 filledAlbedo(const Divided& own, glm::vec3 around, glm::vec3 burntOut,
                       glm::bvec3 isUnlit);

} // namespace relamp
