#pragma once

#include "relamp/lights.h"

#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>

namespace relamp
{

/// Adds the points and the sun of `lights` to the scene that a glTF document shows, as
/// KHR_lights_punctual, a node each.
void addLights(nlohmann::json& document, const Lights& lights, const glm::mat4& worldFromFile);

} // namespace relamp
