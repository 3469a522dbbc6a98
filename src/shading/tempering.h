#pragma once

#include "relamp/lights.h"
#include "shading/texel_shading.h"

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// No light is believed in: the texture is the albedo.
inline bool isOfScan(const Tempering& tempering)
{
    return tempering.power == 0.0f;
}

/// That temperedBy() takes.
glm::vec3 factorOf(const Tempering& tempering);

/// Direct and indirect alike.
void temper(const Tempering& tempering, size_t count, ShadingBlock& shading);
/// The same of irradiance.
std::vector<glm::vec3> tempered(const Tempering& tempering, std::vector<glm::vec3> irradiance);

} // namespace relamp
