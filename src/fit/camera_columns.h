#pragma once

#include "fit/light_model.h"
#include "relamp/response.h"

#include <span>

#include <glm/vec3.hpp>

namespace relamp
{

/// The slopes of a response, less 1, as unknowns beside the light: `texture` is what places show
/// in the file, the camera near `known`.
CameraColumns columnsOf(const Response& known, std::span<const glm::vec3> texture);

} // namespace relamp
