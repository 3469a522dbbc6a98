#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// What is known at places of the scan about the light that falls on them: the irradiance there is
///     sum over lamps of radiance * direct  +  gathered  +  ambient * missed.
struct FitData
{
    size_t lamps = 0;
    size_t burntOut = 0; // how many of the last places are, whose radiance is a lower bound
    std::vector<glm::vec3> radiance; // seen there: mean of texels that are not burnt out, > 0
    std::vector<glm::vec3> gathered; // irradiance by way of surfaces that do not shine
    std::vector<float> missed;       // irradiance of directions that leave the scan, at radiance 1
    std::vector<float> direct;       // [place * lamps + lamp]: irradiance of a lamp at radiance 1

    [[nodiscard]] size_t places() const { return radiance.size() - burntOut; } // that are measured
};

/// Two places that are likely of one material.
struct MaterialPair
{
    uint32_t p;
    uint32_t q;
};

} // namespace relamp
