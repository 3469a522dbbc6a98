#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

namespace relamp
{

/// How far an albedo can be believed, 0..1: 0 where the texture is burnt out or the shading did not
/// reach `darkest`, rising to 1 where all channels are below nine tenths of white and the shading
/// is four times `darkest`. White means nothing in a texture that does not clip there.
float confidence(glm::vec3 radiance, bool clips, glm::vec3 shading, float darkest);

uint8_t confidenceByte(float confidence);

} // namespace relamp
