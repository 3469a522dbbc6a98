#pragma once

#include "fit/light_model.h"
#include "lights/surfel_radiance.h"
#include "relamp/delight.h"
#include "scan/rays.h"
#include "scan/surfels.h"
#include "shading/tempering.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Places that the light was fitted to, and pairs of them that are likely of one paint: on one
/// plane of one room, of one hue as drawPairs() has it, more than half a metre apart, for what lies
/// closer is lit alike and would praise any light, and of one fold (scan/held_out.h).
///
/// Neither the scan nor an albedo is favoured by them: hue is compared as widely as lamps of two
/// colours need, and brightness not at all.
struct Witnesses
{
    std::vector<uint32_t> surfels;
    std::vector<glm::vec3> texture;  // linear, as the scan shows it
    std::vector<glm::vec3> radiance; // the same without what the camera did
    std::vector<float> unseen;       // by how much log albedo is another where no fit looks
    std::vector<uint32_t> cube;      // of places, half a metre wide; those of one err alike
    uint32_t cubes = 0;              // numbered from 0
    std::vector<MaterialPair> pairs; // of places
};

/// `texture` and `radiance`: with and without what the camera did. `changeUnseen`: one a place, or
/// empty; as changeUnseen() has it, of the places that `quality` makes a fit look at.
Witnesses witnessesOf(const Surfels& surfels, const RayScene& scene,
                      std::span<const glm::vec3> texture, const SurfelRadiance& radiance,
                      std::span<const float> changeUnseen, Quality quality, double rooms = 1.0);

/// How far a shading is to be believed that brings `irradiance` to surfels: to the power under
/// which places of one paint agree best, in steps of a tenth; to all of it unless a smaller power
/// is better by two standard errors. Of a power of 0 the camera is not believed either, and the
/// scan itself stands.
///
/// Agreement is the mean of log(1 + (d / 0.2)^2) over pairs that differ by d stops, root mean
/// square over the channels, so that those
/// of two paints, a third to a half of them, hardly count. The standard error is that of cubes:
/// pairs that have one in common err alike.
Tempering temperingFor(const Witnesses& witnesses, std::span<const glm::vec3> irradiance);

/// By how much places of one paint differ in the scan and in the albedo under such a shading.
///
/// The lower quartile of the differences: what half of those pairs exceed that are of one paint
/// where half are. Their median would be of two paints as soon as many pairs are. Nothing is
/// measured where there are fewer than 100 pairs, or these are in fewer than 8 cubes.
///
/// It does not see light that is wrong at fewer places than that. Whether albedo improves on the
/// scan is told by the mean of temperingFor(): it does unless it is worse by two standard errors.
CrossValidation crossValidate(const Witnesses& witnesses, std::span<const glm::vec3> irradiance,
                              const Tempering& tempering);

/// What a person should know of it, and can do; none where the albedo is better than the scan.
std::vector<std::string> warningsOf(const CrossValidation& validation);

} // namespace relamp
