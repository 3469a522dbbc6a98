#pragma once

#include "scan/rays.h"
#include "shading/area_direct.h"
#include "shading/gather.h"
#include "shading/hit_lists.h"
#include "shading/lamp_sight.h"

#include <optional>
#include <span>
#include <vector>

namespace relamp
{

/// Light at every side of every surfel.
struct LitSides
{
    RadianceField field;
    std::vector<glm::vec3> direct; // irradiance from lamps, one a list
    Gathered gathered;             // one a list
    std::vector<glm::vec3> albedo; // of surfels, 0..0.95
};

/// A lamp that sides look for. Their rays start at a few places of each; one from each is right on
/// average over several sides.
struct SoughtLamp
{
    AreaLight light;
    size_t raysPerOrigin = 1;
};

/// Irradiance from each lamp at radiance 1 on the sides that `lists` name; all where empty. Where a
/// lamp is seen from none of 64 sides, each one of `perScout` that follow each other (a power of
/// two), it is from none of these, nor from any room that sees nothing of its own: light that does
/// not reach a room costs little there.
std::vector<LampSight> directOfLists(const Texels& texels, const RayScene& scene,
                                     const HitLists& hits, std::span<const SoughtLamp> lamps,
                                     std::span<const uint32_t> lists = {}, size_t perScout = 1);

/// From one lamp on all sides.
LampSight directOfLists(const Texels& texels, const RayScene& scene, const HitLists& hits,
                        const SoughtLamp& lamp);

/// Standard errors of the surfels around each, itself among them: the root of their mean square.
/// For values that few rays tell, of places of much the same light: a surfel's own is a guess then,
/// and the lower the darker what they met by chance. Beside something very bright it is too much.
std::vector<float> noiseAround(const Surfels& surfels, std::span<const float> noise);

/// Draws every surfel's value towards the mean around it, all the way where their difference may be
/// `noise`, the standard error of its luminance.
std::vector<glm::vec3> withoutNoise(const Surfels& surfels, std::span<const glm::vec3> values,
                                    std::span<const float> noise);

/// Irradiance at the front of every surfel that did not come from a lamp.
///
/// Walls beside a lamp send out more than white from a small area, which few rays meet: what is
/// above white is spread over the surfels around, or it would show as spots.
std::vector<glm::vec3> indirectOfFronts(const Surfels& surfels, const HitLists& hits,
                                        const LitSides& sides);

/// Albedo of surfels by their plain texels under `irradiance` of their fronts, 0.02..0.95; those
/// that are burnt out nearly all over are guessed.
std::vector<glm::vec3> albedoOf(const Texels& texels, const SurfelRadiance& radiance,
                                std::span<const glm::vec3> irradiance);

/// Whether enough of a surfel is not burnt out.
bool knowsItsAlbedo(const SurfelRadiance& radiance, size_t surfel);

/// Gives surfels that are burnt out nearly all over the mean albedo of their neighbours.
void guessBurntOut(const Texels& texels, const SurfelRadiance& radiance,
                   std::span<glm::vec3> albedo);

/// Settles what the texture does not show: burnt-out walls send out albedo * irradiance / pi and
/// not the white that they show, backs are lit by what is behind them. `shines` marks the lamps'
/// surfels.
/// `direct` is the irradiance from all lamps, one a list. `settled`: what somebody else has found
/// that sides gather.
LitSides lightSides(const Texels& texels, const HitLists& hits, const SurfelRadiance& radiance,
                    std::vector<glm::vec3> direct, std::span<const uint8_t> shines,
                    const OutsideLight& outside, std::optional<Gathered> settled = {});

} // namespace relamp
