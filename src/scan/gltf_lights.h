#pragma once

#include "relamp/lights.h"

#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>

namespace relamp
{

/// Adds the points and the sun of `lights` to the scene that a glTF document shows, as
/// KHR_lights_punctual, a node each; those that stand for a surface that faces one way as spots.
///
/// By glTF they are candela and lux, which radiance becomes by what the texture's white stands for:
/// in that scene 1 cd/m^2, as viewers show it, and in a second scene of the same room what Blender
/// takes for white. Each says so in extras.relamp.whiteNits; intensity / whiteNits is radiance m^2.
void addLights(nlohmann::json& document, const Lights& lights, const glm::mat4& worldFromFile);

} // namespace relamp
