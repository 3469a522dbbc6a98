#pragma once

#include "relamp/image.h"
#include "relamp/relight.h"

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Directions to the sky, in bins of equal area in cylinder coordinates.
struct SkyBins
{
    static constexpr size_t kAround = 64;
    static constexpr size_t kUp = 32;
    static constexpr size_t kCount = kAround * kUp;

    static size_t of(glm::vec3 direction);
    static glm::vec3 middleOf(size_t bin);
};

/// What is seen of a sky, which must outlive this: radiance in a direction.
class SeenSky
{
public:
    explicit SeenSky(const Sky& sky);

    [[nodiscard]] glm::vec3 operator()(glm::vec3 direction) const;

private:
    const Sky& sky_;
    std::optional<Radiance> picture_;
};

/// Mean radiance of every bin.
std::vector<glm::vec3> skyInBins(const Sky& sky);

/// Radiance of a window opening that the sky shines on from behind and that spreads it evenly:
/// irradiance / pi. `outwards` is unit; zero: all directions count alike.
glm::vec3 skyThroughOpening(const std::vector<glm::vec3>& bins, glm::vec3 outwards);

} // namespace relamp
