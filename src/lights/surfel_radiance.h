#pragma once

#include "base/radiometry.shared.h"
#include "relamp/progress.h"
#include "scan/pixel_marks.h"
#include "scan/texels.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// The burnt-out texels of one surfel.
struct ClippedPatch
{
    glm::vec3 position{0.0f}; // world, mean
    glm::vec3 normal{0.0f};   // unit, mean
    float area = 0.0f;        // m^2
    uint32_t surfel = 0;
    glm::vec3 radiance{1.0f}; // mean that the texture shows; was more
};

/// Length of the mean normal of a lamp's patches, below which it shines all around.
inline constexpr float kNoFacing = 0.3f;

/// What the texture says of the light that leaves every surfel.
struct SurfelRadiance
{
    std::vector<glm::vec3> plain;      // mean of its texels that are not burnt out; linear
    std::vector<float> plainArea;      // of these, m^2; where it is 0, `plain` is white
    std::vector<float> clippedArea;    // of the others
    std::vector<ClippedPatch> clipped; // ascending by surfel
    PixelMarks isClipped;              // where a texel is burnt out
    std::vector<glm::vec3> white;      // what white of the texture stands for; empty: 1
    std::vector<float> limit;          // of luminance, by energy_limit.h; empty: there is none

    [[nodiscard]] glm::vec3 whiteOf(size_t surfel) const
    {
        return white.empty() ? glm::vec3(1.0f) : white[surfel];
    }

    /// What of the radiance that a surfel shows the room can be lit by.
    [[nodiscard]] glm::vec3 sent(size_t surfel, glm::vec3 shown) const
    {
        if (limit.empty()) return shown;
        return std::min(limit[surfel] / std::max(luminance(shown), kFaintest), 1.0f) * shown;
    }
};

/// Whether most of a surfel is burnt out: then it sent more than it shows.
inline bool isMostlyBurntOut(const SurfelRadiance& radiance, size_t surfel)
{
    return radiance.clippedArea[surfel] > radiance.plainArea[surfel];
}

/// Whether so little of it is that what is left of it tells its paint.
inline bool isHardlyBurntOut(const SurfelRadiance& radiance, size_t surfel)
{
    return radiance.clippedArea[surfel] <= 0.1f * radiance.plainArea[surfel];
}

/// Walks all texels once. A texture that can hold more than white (float formats) counts as burnt
/// out from white on. `isBurntOut`, if it is not empty, says instead which texels are, as
/// SurfelRadiance::isClipped: of a texture that is no photo. `linearization`: null, there is none.
SurfelRadiance collectRadiance(const Texels& texels, Progress& progress,
                               std::span<const std::vector<bool>> isBurntOut = {},
                               const Linearization* linearization = nullptr);

} // namespace relamp
