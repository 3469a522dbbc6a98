#pragma once

#include "shading/texel_shading.h"

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// How far the shading of a room is believed: it is what was found to this power, but for
/// a factor.
struct Tempering
{
    glm::vec3 kept{1.0f}; // shading that stays as it is, > 0
    float power = 1.0f;   // 0..1; 1: all of it is, 0: none

    /// No light is believed in: the texture is the albedo.
    static Tempering ofScan() { return {glm::vec3(1.0f), 0.0f}; }
    [[nodiscard]] bool isOfScan() const { return power == 0.0f; }
};

/// Direct and indirect alike.
void temper(const Tempering& tempering, size_t count, ShadingBlock& shading);
/// The same of irradiance.
std::vector<glm::vec3> tempered(const Tempering& tempering, std::vector<glm::vec3> irradiance);

} // namespace relamp
