#pragma once

#include "fit/light_model.h"
#include "relamp/camera_model.h"

#include <span>

#include <glm/vec3.hpp>

namespace relamp
{

constexpr double kTintSpread = 0.07; // log: of red or blue over green, by automatic white balance

/// What is known of a camera before its white balance is.
struct DriftBelief
{
    double exposure;    // how likely it drifted, 0..1: white balance did with it
    double independent; // pairs that all are worth, > 0, where what looks like drift is not
};

/// The gain with the colour that its white balance drifts to, on the same lattice; its brightness
/// stays. Where no drift is likely, by the pairs or by `belief`, they are worth few.
///
/// `albedo`: of places, as that gain and the light that was found make it, > 0; places of one paint
/// have one colour. `told`: pairs that a person called one paint.
Gain withWhiteBalance(Gain gain, std::span<const glm::vec3> position,
                      std::span<const glm::vec3> albedo, std::span<const MaterialPair> pairs,
                      std::span<const MaterialPair> told, const DriftBelief& belief);

} // namespace relamp
