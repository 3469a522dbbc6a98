#pragma once

#include <array>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace relamp
{

/// Light from all around a place in nine spherical harmonics: R. Ramamoorthi, P. Hanrahan, "An
/// Efficient Representation for Irradiance Environment Maps", 2001. Enough for what is matte.
struct WebHarmonics
{
    static constexpr size_t kCount = 9;

    std::array<glm::vec3, kCount> of{}; // integrals of radiance times basis

    /// Of a unit direction.
    static std::array<float, kCount> basis(glm::vec3 d)
    {
        return {0.282095f,
                0.488603f * d.y,
                0.488603f * d.z,
                0.488603f * d.x,
                1.092548f * d.x * d.y,
                1.092548f * d.y * d.z,
                0.315392f * (3.0f * d.z * d.z - 1.0f),
                1.092548f * d.x * d.z,
                0.546274f * (d.x * d.x - d.y * d.y)};
    }

    /// Irradiance on a surface that faces `light` from a unit direction.
    void add(glm::vec3 direction, glm::vec3 light)
    {
        const std::array<float, kCount> values = basis(direction);
        for (size_t i = 0; i < kCount; ++i) of[i] += values[i] * light;
    }

    /// Irradiance / pi on a surface of a unit normal, never negative.
    [[nodiscard]] glm::vec3 shading(glm::vec3 normal) const
    {
        constexpr std::array<float, kCount> kOfCosine{1.0f,  2.0f / 3, 2.0f / 3, 2.0f / 3, 0.25f,
                                                      0.25f, 0.25f,    0.25f,    0.25f}; // over pi
        const std::array<float, kCount> values = basis(normal);
        glm::vec3 sum(0.0f);
        for (size_t i = 0; i < kCount; ++i) sum += kOfCosine[i] * values[i] * of[i];
        return glm::max(sum, glm::vec3(0.0f));
    }
};

} // namespace relamp
