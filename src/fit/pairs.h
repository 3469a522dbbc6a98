#pragma once

#include "fit/light_model.h"
#include "scan/rays.h"
#include "scan/surfels.h"

#include <span>
#include <vector>

namespace relamp
{

constexpr float kPaintStep = 0.3f; // of log albedo between two of one paint: more is an edge

/// Whether two surfels lie on one plane, as walls, floors and table tops are.
bool areOnOnePlane(const Surfels& surfels, uint32_t p, uint32_t q);
/// Whether two radiances do not rule out one material under differently coloured light.
bool haveOneColor(glm::vec3 shownP, glm::vec3 shownQ);

/// How many rooms of one size a scan is worth, >= 1: the inverse of the chance that two places of
/// one floor are in one room, or of one ceiling, whichever is more. All of a storey is on the plane
/// of its floor, its ceilings may hang at different heights; a wall's plane is mostly that of one
/// room.
double roomsOf(const Surfels& surfels, const RayScene& scene);

/// Draws pairs of places that lie on one plane, as walls, floors and table tops do, near and far,
/// in one room (scan/one_room.h), and whose colours do not rule out one material under differently
/// coloured light.
///
/// `shown` is the radiance of places, `surfels` their indices into `all`; `rooms` says which room
/// they are in, from 0 on, so that as many are found in each as were it alone; empty: one.
/// Deterministic. At most `perPlace` pairs begin at each place.
std::vector<MaterialPair> drawPairs(std::span<const glm::vec3> shown,
                                    std::span<const uint32_t> surfels, const Surfels& all,
                                    const RayScene& scene, size_t perPlace,
                                    std::span<const uint8_t> rooms = {});

/// Draws pairs across the walls of each room, by `albedo` of places, >= 0, as the light that was
/// found makes it once white balance is undone: upright places on different planes that are of one
/// hue and about as bright. Hue tells paints apart, for it hardly depends on the light; brightness
/// alone would take every wall for the next where exposure drifts.
///
/// Each upright place looks at `perPlace` others, whatever their paint, and pairs with those that
/// agree: were it to look until some do, noise would pair it with another paint. `albedo` is of as
/// many places as `surfels`; one that is 0 in a channel agrees with none. All else as drawPairs().
std::vector<MaterialPair> drawAcrossWalls(std::span<const glm::vec3> albedo,
                                          std::span<const uint32_t> surfels, const Surfels& all,
                                          size_t perPlace, std::span<const uint8_t> rooms = {});

} // namespace relamp
