#pragma once

#include "lights/surfel_radiance.h"
#include "scan/texels.h"

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// A piece of a lamp so small that it is a point: a texel.
struct LampTexel
{
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};   // unit
    float area = 0.0f;        // m^2
    glm::vec3 radiance{0.0f}; // that it sends to whoever sees its front
    bool isOfScan = true;     // whether rays meet it there
};

/// A lamp by the patches of surfels that it is made of.
struct Shiner
{
    std::span<const ClippedPatch> patches;
    glm::vec3 radiance{0.0f};
};

/// The burnt-out texels of the lamps' surfels. A patch of no surfel, as a light has that a person
/// put up, is one piece, and not of the scan.
std::vector<LampTexel> lampTexels(const Texels& texels, const SurfelRadiance& radiance,
                                  std::span<const Shiner> lamps);

/// All lamps of a room as something to choose a point on, by power.
class LampSurface
{
public:
    LampSurface() = default;
    explicit LampSurface(std::vector<LampTexel> texels);

    struct Choice
    {
        const LampTexel& texel;
        float area; // m^2 that it stands for: its own over the chance that it is chosen
    };
    /// Chance by area, 1 / m^2, that a point of this radiance is chosen.
    [[nodiscard]] float density(glm::vec3 radiance) const;
    [[nodiscard]] bool isDark() const { return powerUpTo_.empty() || powerUpTo_.back() <= 0.0f; }
    /// The piece at which `share` (0..1) of all power is reached. There must be some.
    [[nodiscard]] Choice at(float share) const;

private:
    std::vector<LampTexel> texels_;
    std::vector<float> powerUpTo_; // luminance * m^2
};

} // namespace relamp
