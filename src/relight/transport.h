#pragma once

#include "lights/surfel_radiance.h"
#include "scan/texels.h"
#include "shading/hit_lists.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

namespace relamp
{

/// What of a room decides how light goes about in it, whatever the light: who sees whom, and which
/// surface each of its fixtures has. Found once, kept in a file.
struct Transport
{
    std::vector<Side> sides;        // whose light is followed, one a list; fronts first
    std::vector<uint32_t> first{0}; // of lists, and one more: where its targets begin
    std::vector<uint32_t> target;   // what its rays met, each as likely: an index of radiances
    std::vector<uint32_t> few;      // of lists: so many targets are an even choice of all
    std::vector<std::vector<ClippedPatch>> fixtures; // surface of each captured one
    std::vector<std::vector<uint8_t>> buried;        // Texels::buried

    [[nodiscard]] size_t lists() const { return sides.size(); }
    /// Radiances are those of the lists, then of SkyBins, then nothing.
    [[nodiscard]] size_t radiances() const;
};

/// The lists with what every ray met looked up: radiance index in place of side, bin of the sky in
/// place of nothing.
Transport transportOf(const Texels& texels, const HitLists& hits, size_t rays);

/// Irradiance on every list: pi times the mean of the radiances that it sees. `isFew`: of the even
/// choice alone.
void gatherRadiance(const Transport& transport, std::span<const glm::vec4> radiance, bool isFew,
                    std::span<glm::vec4> irradiance);

} // namespace relamp
