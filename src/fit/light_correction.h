#pragma once

#include "lights/surfel_radiance.h"
#include "scan/surfels.h"
#include "scan/texels.h"
#include "shading/gathered_light.h"
#include "shading/hit_lists.h"
#include "shading/texel_shading.h"

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Light on surfels as the mesh has it, with this spread: the mean of a surfel's texels that are
/// not burnt out.
SurfelLighting foundLight(const Texels& texels, const SurfelRadiance& radiance,
                          const TexelShading& shade, std::vector<float> spread);

/// How much of the light that was found on each surfel is there, 0..1.275: the rest leaks in where
/// the mesh is open, or is kept out by what the mesh lacks; more than all where it has shadows that
/// the texture does not show.
///
/// A smooth change within one paint is light, an edge is paint (Land and McCann 1971); places of
/// one paint have one albedo, near and far. Light is believed by its variance: little where a
/// shadow's edge is near, where backs are seen and in the dark. `hits`: of all fronts. A surfel
/// that is burnt out keeps its light. A thin pattern is paint unless `hits` say that something is
/// near. The middle of all places keeps its light. `gaps`: as Lights.
std::vector<float> correctionOf(const Surfels& surfels, const SurfelRadiance& radiance,
                                const HitLists& hits, const SurfelLighting& light,
                                float gaps = 0.0f);

/// The shading times that, interpolated between surfels; direct and indirect alike. `lit` empty: as
/// it is.
TexelShading corrected(const Texels& texels, TexelShading shade, std::span<const float> lit);

/// The same of light on surfels.
std::vector<glm::vec3> corrected(std::span<const glm::vec3> ofSurfels, std::span<const float> lit);

/// What surfels of this albedo, 0..1, reflect of light as the mesh has it, 0..1.
std::vector<glm::vec3> reflectanceBy(std::span<const glm::vec3> albedo, std::span<const float> lit);

} // namespace relamp
