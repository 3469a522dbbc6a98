#pragma once

#include "fit/light_model.h"
#include "relamp/camera_model.h"

#include <span>

#include <glm/vec3.hpp>

namespace relamp
{

/// The gain with the colour that its white balance drifts to, on the same lattice; its brightness
/// stays.
///
/// `albedo`: of places, as that gain and the light that was found make it, > 0; places of one paint
/// have one colour. `told`: pairs that a person called one paint.
Gain withWhiteBalance(Gain gain, std::span<const glm::vec3> position,
                      std::span<const glm::vec3> albedo, std::span<const MaterialPair> pairs,
                      std::span<const MaterialPair> told = {});

} // namespace relamp
